// Machines without a driver, played by environment variables in a process of its own: a sentence comes back, nothing is
// printed, nothing ends the process.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <iostream>

#include "viewer/render/renderer.h"

namespace aerascope {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr const char* kBegin = "[[[";
constexpr const char* kEnd = "]]]";

// What the other process runs.
TEST(NoEgl, DISABLED_Probe) {
  const auto renderer = Renderer::Create();
  std::cout << kBegin << (renderer ? "works" : renderer.error().message) << kEnd << std::endl;
}

struct Outcome {
  std::string message;
  std::string standard_error;
};

Outcome CreateRendererWith(const std::string& environment) {
  const std::string program = std::filesystem::read_symlink("/proc/self/exe").string();
  const std::string command = "env -u GTEST_OUTPUT " + environment + " '" + program +
                              "' --gtest_also_run_disabled_tests --gtest_filter=NoEgl.DISABLED_Probe 2>&1 </dev/null";
  std::string output;
  std::FILE* pipe = popen(command.c_str(), "r");
  std::array<char, 4096> buffer;
  while (const std::size_t read = std::fread(buffer.data(), 1, buffer.size(), pipe)) output.append(buffer.data(), read);
  EXPECT_EQ(pclose(pipe), 0) << output;
  const std::size_t begin = output.find(kBegin);
  const std::size_t end = output.find(kEnd);
  if (begin == std::string::npos || end == std::string::npos) return {"no answer", output};
  const std::size_t start = output.find("[ RUN      ]");
  const std::size_t line = output.find('\n', start) + 1;  // what lies between this and the answer is not ours
  return {output.substr(begin + 3, end - begin - 3), output.substr(line, begin - line)};
}

TEST(NoEgl, WithoutAVendorTheSentenceSaysWhatToInstall) {
  const Outcome outcome = CreateRendererWith("__EGL_VENDOR_LIBRARY_DIRS=/nonexistent");
  EXPECT_THAT(outcome.message, AllOf(HasSubstr("frames cannot be drawn"), HasSubstr("libgl1-mesa-dri")));
  EXPECT_EQ(outcome.standard_error, "");
}

TEST(NoEgl, WithoutADriverTheSentenceSaysWhatToInstall) {
  const Outcome outcome = CreateRendererWith("LIBGL_DRIVERS_PATH=/nonexistent GBM_BACKENDS_PATH=/nonexistent");
  EXPECT_THAT(outcome.message, AllOf(HasSubstr("frames cannot be drawn"), HasSubstr("libgl1-mesa-dri")));
  EXPECT_EQ(outcome.standard_error, "");
}

TEST(NoEgl, AWrongDisplayOfTheUserDoesNoHarm) {
  const Outcome with_display = CreateRendererWith("DISPLAY=:99");
  EXPECT_EQ(with_display.message, CreateRendererWith("-u DISPLAY").message);
  EXPECT_EQ(with_display.standard_error, "");
}

}  // namespace
}  // namespace aerascope
