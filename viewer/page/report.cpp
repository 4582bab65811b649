#include "viewer/page/report.h"

#include <algorithm>
#include <initializer_list>
#include <map>
#include <string_view>

#include "engine/base/markup.h"
#include "engine/base/text.h"
#include "viewer/page/embedded_report.inc"
#include "viewer/page/page_blocks.h"
#include "viewer/page/page_template.h"
#include "viewer/page/report_data.h"

namespace aerascope {
namespace {

std::string_view EndingOf(std::string_view mime) {
  const std::size_t slash = mime.find('/');
  const std::string_view kind = slash == std::string_view::npos ? mime : mime.substr(slash + 1);
  for (const std::string_view known : {"webp", "png", "webm"})
    if (kind.starts_with(known)) return known;
  return "bin";
}

// Each image once, under a name made from its content, and the video: into the page, or as files beside it.
class Pictures {
 public:
  Pictures(const ReportFrames& frames, const std::string& folder) : folder_(folder) {
    for (const Still& still : frames.stills) Add("frames", frames.mime, still.bytes);
    for (const FilmView& view : frames.views)
      for (const Still& still : view.stills) Add("frames", frames.mime, still.bytes);
    if (frames.video) Add("video", frames.video->mime, frames.video->bytes);
  }

  // In the order that FilmData asks for.
  const std::vector<std::string>& names() const { return names_; }
  const PageBlocks& blocks() const { return blocks_; }
  std::vector<ReportFile> TakeFiles() {
    std::vector<ReportFile> files;
    for (auto& [path, bytes] : files_) files.push_back({path, std::move(bytes)});
    return files;
  }

 private:
  void Add(const std::string& part, const std::string& mime, const std::string& bytes) {
    const std::string name = (part == "video" ? "video-" : "image-") + ToText(HashOf(bytes)).substr(0, 16);
    names_.push_back(name);
    if (folder_.empty()) {
      blocks_.Add(part, name, mime, bytes);
      return;
    }
    const std::string path = folder_ + "/" + name + "." + std::string(EndingOf(mime));
    blocks_.AddFile(part, name, mime, path);
    files_.try_emplace(path, bytes);
  }

  const std::string& folder_;
  PageBlocks blocks_;
  std::vector<std::string> names_;
  std::map<std::string, std::string> files_;
};

std::string Megabytes(std::size_t bytes) {
  return FormatNumber(static_cast<double>(bytes) / 1e6, 3) + " MB";
}

}  // namespace

Result<Report> BuildReport(const Run& run, const ReportFrames& frames, const ReportOptions& options) {
  ReportBlocks data;
  Pictures pictures(frames, options.picture_folder);
  if (Status added = AddReportData(run, frames, pictures.names(), options, &data); !added)
    return added.error();
  const std::string title = EscapeMarkup(ReportTitle(run));
  const std::string policy = ContentPolicy(kScriptSha256, kStyleSha256, !options.picture_folder.empty());
  // What the page needs to open stands before its script, which does not wait for the rest.
  const std::string& first = data.first.html();
  const std::string rest = data.later.html() + pictures.blocks().html();

  Report report;
  report.html = Filled(kPage, {{"policy", policy},
                               {"title", title},
                               {"style", kStyle},
                               {"script", kScript},
                               {"first", first},
                               {"rest", rest}});
  report.parts.push_back({"page", report.html.size() - first.size() - rest.size()});
  std::map<std::string, std::size_t> parts;
  for (const PageBlocks* blocks :
       std::initializer_list<const PageBlocks*>{&data.first, &data.later, &pictures.blocks()})
    for (const auto& [name, bytes] : blocks->parts()) parts[name] += bytes;
  for (const auto& [name, bytes] : parts) report.parts.push_back({name, bytes});
  report.files = pictures.TakeFiles();
  if (report.html.size() > kLargeReport) {
    const auto largest =
        std::max_element(report.parts.begin(), report.parts.end(),
                         [](const ReportPart& a, const ReportPart& b) { return a.bytes < b.bytes; });
    report.warnings.push_back(
        "The report is " + Megabytes(report.html.size()) + ", more than " + Megabytes(kLargeReport) +
        ", and may open slowly: " + largest->name + " take " + Megabytes(largest->bytes) + " of it" +
        (largest->name == "frames"
             ? "; smaller or fewer frames make it lighter, or --folder, which puts them beside it."
             : "."));
  }
  return report;
}

}  // namespace aerascope
