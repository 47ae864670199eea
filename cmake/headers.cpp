// Nothing: cmake/headers.h is parsed for the others.
