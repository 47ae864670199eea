#include "osteon/render/software_gl.h"

#include <gtest/gtest.h>

namespace osteon {
namespace {

TEST(SoftwareGl, KnowsTheDriversThatDrawWithTheProcessor) {
  for (const char* name : {"llvmpipe (LLVM 15.0.6, 256 bits)", "softpipe",
                           "Software Rasterizer swrast", "OpenSWR SWR (LLVM 9.0, 256 bits)"})
    EXPECT_TRUE(is_software_gl(name)) << name;
}

TEST(SoftwareGl, AGraphicsCardIsNone) {
  for (const char* name :
       {"", "NVIDIA GeForce RTX 3060/PCIe/SSE2", "AMD Radeon RX 6600 (navi23, LLVM 15)",
        "Mesa Intel(R) UHD Graphics 620 (KBL GT2)"})
    EXPECT_FALSE(is_software_gl(name)) << name;
}

}  // namespace
}  // namespace osteon
