// The one place where stb's reader of pictures is compiled; its header may be read anywhere.
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#include <stb/stb_image.h>
