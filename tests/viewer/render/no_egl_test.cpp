// Machines without a driver, played by environment variables in a process of its own: a sentence comes back,
// nothing is printed, nothing ends the process.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <string>

namespace aerascope {
namespace {

using ::testing::MatchesRegex;

// What the program renderer_probe printed, on both of its outputs together.

std::string ProbeWith(const std::string& environment) {
  const std::string command = "env " + environment + " '" RENDERER_PROBE "' 2>&1 </dev/null";
  std::string output;
  std::FILE* pipe = popen(command.c_str(), "r");
  std::array<char, 4096> buffer;
  while (const std::size_t read = std::fread(buffer.data(), 1, buffer.size(), pipe))
    output.append(buffer.data(), read);
  EXPECT_EQ(pclose(pipe), 0) << output;
  return output;
}

TEST(NoEgl, WithoutAVendorTheSentenceSaysWhatToInstall) {
  EXPECT_EQ(ProbeWith("__EGL_VENDOR_LIBRARY_DIRS=/nonexistent"),
            "frames cannot be drawn: EGL gives no OpenGL (EGL: no driver for any platform is installed); "
            "install the packages libegl1, libegl-mesa0 and libgl1-mesa-dri\n");
}

TEST(NoEgl, WithoutADriverTheSentenceSaysWhatToInstall) {
  EXPECT_THAT(
      ProbeWith("LIBGL_DRIVERS_PATH=/nonexistent"),
      MatchesRegex("frames cannot be drawn: EGL gives no OpenGL \\(surfaceless: EGL_NOT_INITIALIZED, .*\\); "
                   "install the packages libegl1, libegl-mesa0 and libgl1-mesa-dri\n"));
}

TEST(NoEgl, AWrongDisplayOfTheUserDoesNoHarm) {
  EXPECT_EQ(ProbeWith("DISPLAY=:99"), ProbeWith("-u DISPLAY"));
}

}  // namespace
}  // namespace aerascope
