#include <gtest/gtest.h>

#include "../cmake/headers.h"
