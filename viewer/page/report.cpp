#include "viewer/page/report.h"

#include <algorithm>
#include <map>
#include <string_view>

#include "engine/base/markup.h"
#include "engine/base/text.h"
#include "viewer/page/embedded_page.inc"
#include "viewer/page/encoding.h"
#include "viewer/page/page_blocks.h"
#include "viewer/page/report_data.h"

namespace aerascope {
namespace {

std::string ContentPolicy() {
  return "default-src 'none'; script-src 'sha256-" + Base64(BytesOfHex(kScriptSha256)) +
         "'; style-src 'sha256-" + Base64(BytesOfHex(kStyleSha256)) +
         "'; img-src blob: data:; media-src blob:; base-uri 'none'; form-action 'none'";
}

// Each image once, under a name made from its content, and the video; gives the names in the order that
// FilmData asks for.
std::vector<std::string> AddImages(const ReportFrames& frames, PageBlocks* blocks) {
  std::vector<std::string> names;
  const auto add = [&](const std::string& part, const std::string& mime, const std::string& bytes) {
    names.push_back((part == "video" ? "video-" : "image-") + ToText(HashOf(bytes)).substr(0, 16));
    blocks->Add(part, names.back(), mime, bytes);
  };
  for (const Still& still : frames.stills) add("frames", frames.mime, still.bytes);
  for (const FilmView& view : frames.views)
    for (const Still& still : view.stills) add("frames", frames.mime, still.bytes);
  if (frames.video) add("video", frames.video->mime, frames.video->bytes);
  return names;
}

// The template with every @name@ replaced; a name without a value stays.
std::string Filled(std::string_view page, const std::map<std::string_view, std::string_view>& values) {
  std::string filled;
  std::size_t at = 0;
  while (at < page.size()) {
    const std::size_t open = page.find('@', at);
    const std::size_t close = open == std::string_view::npos ? open : page.find('@', open + 1);
    if (close == std::string_view::npos) break;
    const auto value = values.find(page.substr(open + 1, close - open - 1));
    filled += page.substr(at, open - at);
    if (value == values.end()) {
      filled += '@';
      at = open + 1;
      continue;
    }
    filled += value->second;
    at = close + 1;
  }
  filled += page.substr(at);
  return filled;
}

std::string Megabytes(std::size_t bytes) {
  return FormatNumber(static_cast<double>(bytes) / 1e6, 3) + " MB";
}

}  // namespace

Result<Report> BuildReport(const Run& run, const ReportFrames& frames, const ReportOptions& options) {
  ReportBlocks data;
  PageBlocks images;
  const std::vector<std::string> names = AddImages(frames, &images);
  if (Status added = AddReportData(run, frames, names, options, &data); !added) return added.error();
  const std::string title = EscapeMarkup(ReportTitle(run));
  const std::string policy = ContentPolicy();
  // What the page needs to open stands before its script, which does not wait for the rest.
  const std::string& first = data.first.html();
  const std::string rest = data.later.html() + images.html();

  Report report;
  report.html = Filled(kPage, {{"policy", policy},
                               {"title", title},
                               {"style", kStyle},
                               {"script", kScript},
                               {"first", first},
                               {"rest", rest}});
  report.parts.push_back({"page", report.html.size() - first.size() - rest.size()});
  std::map<std::string, std::size_t> parts;
  for (const PageBlocks* blocks : {&data.first, &data.later, &images})
    for (const auto& [name, bytes] : blocks->parts()) parts[name] += bytes;
  for (const auto& [name, bytes] : parts) report.parts.push_back({name, bytes});
  if (report.html.size() > kLargeReport) {
    const auto largest =
        std::max_element(report.parts.begin(), report.parts.end(),
                         [](const ReportPart& a, const ReportPart& b) { return a.bytes < b.bytes; });
    report.warnings.push_back(
        "The report is " + Megabytes(report.html.size()) + ", more than " + Megabytes(kLargeReport) +
        ", and may open slowly: " + largest->name + " take " + Megabytes(largest->bytes) + " of it" +
        (largest->name == "frames" ? "; smaller or fewer frames make it lighter." : "."));
  }
  return report;
}

}  // namespace aerascope
