#include "cli.h"

int main(int argc, char** argv) { return osteon::run_cli(argc, argv); }
