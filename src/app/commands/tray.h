#pragma once

#include "runs/tray.h"  // the trays of commands and of the window are made alike
