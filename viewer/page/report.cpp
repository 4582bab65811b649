#include "viewer/page/report.h"

#include <map>
#include <string_view>

#include "engine/base/markup.h"
#include "engine/base/text.h"
#include "viewer/page/embedded_page.inc"
#include "viewer/page/encoding.h"
#include "viewer/page/report_data.h"

namespace aerascope {
namespace {

// A block of the page that a browser does not look into until the script asks for it.
std::string InertBlock(const std::string& id, const std::string& mime, bool packed, std::string_view bytes) {
  return "<script type=\"application/octet-stream\" id=\"" + id + "\" data-type=\"" + EscapeMarkup(mime) +
         "\"" + (packed ? " data-packed=\"gzip\"" : "") + ">" + Base64(bytes) + "</script>\n";
}

std::string ContentPolicy() {
  return "default-src 'none'; script-src 'sha256-" + Base64(BytesOfHex(kScriptSha256)) +
         "'; style-src 'sha256-" + Base64(BytesOfHex(kStyleSha256)) +
         "'; img-src blob: data:; base-uri 'none'; form-action 'none'";
}

// Each image once, under a name made from its content.
struct ImageBlocks {
  std::string html;
  std::vector<std::string> names;  // per still
};
ImageBlocks MakeImageBlocks(const ReportFrames& frames) {
  ImageBlocks blocks;
  std::map<Hash128, std::string> known;
  for (const Still& still : frames.stills) {
    const Hash128 content = HashOf(still.bytes);
    const auto [entry, is_new] = known.try_emplace(content, "image-" + ToText(content).substr(0, 16));
    if (is_new) blocks.html += InertBlock(entry->second, frames.mime, false, still.bytes);
    blocks.names.push_back(entry->second);
  }
  return blocks;
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
  const ImageBlocks images = MakeImageBlocks(frames);
  auto packed = Gzip(ReportData(run, frames, images.names, options));
  if (!packed) return packed.error();
  const std::string data = InertBlock("report-data", "application/json", true, *packed);
  const std::string title = EscapeMarkup(ReportTitle(run));
  const std::string policy = ContentPolicy();
  const std::string blocks = data + images.html;

  Report report;
  report.html = Filled(
      kPage,
      {{"policy", policy}, {"title", title}, {"style", kStyle}, {"script", kScript}, {"data", blocks}});
  report.parts = {
      {"page", report.html.size() - blocks.size()}, {"data", data.size()}, {"frames", images.html.size()}};
  if (report.html.size() > kLargeReport)
    report.warnings.push_back("The report is " + Megabytes(report.html.size()) + ", more than " +
                              Megabytes(kLargeReport) + ", and may open slowly: frames take " +
                              Megabytes(images.html.size()) +
                              " of it; smaller or fewer frames make it lighter.");
  return report;
}

}  // namespace aerascope
