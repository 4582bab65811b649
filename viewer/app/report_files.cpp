#include "viewer/app/report_files.h"

#include <filesystem>
#include <system_error>

#include "viewer/app/file_output.h"
#include "viewer/app/pictures.h"
#include "viewer/app/terminal.h"
#include "viewer/draw/png.h"
#include "viewer/page/report.h"

namespace aerascope {
namespace {

std::string Kilobytes(std::size_t bytes) {
  return std::to_string((bytes + 999) / 1000) + " kB";
}

// "out/report.html" -> "out/report_files".
std::filesystem::path PictureFolder(const std::string& html) {
  const std::filesystem::path path(html);
  return path.parent_path() / (path.stem().string() + "_files");
}

Status WritePictures(const std::filesystem::path& folder, const std::vector<ReportFile>& files) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    return Error{folder.string() + ": the folder for pictures cannot be made (" + error.message() +
                 "); choose another place with -o, or leave out --folder"};
  }
  for (const ReportFile& file : files) {
    const std::string path = (folder.parent_path() / file.path).string();
    if (Status written = WriteFile(path, file.bytes); !written) return written;
  }
  return Ok();
}

}  // namespace

Status WriteReports(const Run& run, const std::string& episode_path, const ReportFiles& files) {
  for (const std::string& path : {files.html, files.sheet}) {
    if (path.empty()) continue;
    if (Status fine = CheckWritable(path); !fine) return fine;
  }
  if (files.folder && (files.html.empty() || files.html == "-")) {
    return Error{
        "--folder puts pictures beside the page, so the page needs a file: name it with -o FILE.html"};
  }
  if (!files.html.empty() && files.html == files.sheet) {
    return Error{"the report and the sheet cannot both be " + files.html + "; name two files"};
  }
  ProgressLine progress;
  ReportFrames film;
  SheetFrames sheet_frames;
  if (files.frames) {
    auto pictures = EpisodePictures::Open(run);
    if (!pictures) return pictures.error();
    const auto drawing = [&](const std::string& what) {
      return [&progress, what](std::size_t done, std::size_t of) {
        progress.Show("drawing " + what + ": " + std::to_string(done) + " of " + std::to_string(of));
      };
    };
    if (!files.html.empty()) {
      auto drawn = MakeFilm(run, *pictures, files.film, drawing("the film"));
      if (!drawn) return drawn.error();
      film = std::move(*drawn);
    }
    if (!files.sheet.empty()) {
      auto drawn = pictures->ForSheet(drawing("the sheet"));
      if (!drawn) return drawn.error();
      sheet_frames = std::move(*drawn);
    }
    if (!pictures->can_draw()) progress.Keep("no frames: " + pictures->trouble());
  } else {
    film.note = sheet_frames.note = "Frames were left out as asked (--no-frames).";
  }
  // Both are made before the first is written, so that trouble with one leaves no other behind.
  std::string html;
  std::string sheet;
  std::vector<std::string> remarks;
  std::vector<ReportFile> pictures_beside;
  if (!files.html.empty()) {
    ReportOptions options{.file_name = FileName(episode_path)};
    if (files.folder) options.picture_folder = PictureFolder(files.html).filename().string();
    auto report = BuildReport(run, film, options);
    if (!report) return report.error();
    html = std::move(report->html);
    pictures_beside = std::move(report->files);
    std::string sizes;
    for (const ReportPart& part : report->parts) {
      if (part.bytes == 0) continue;
      sizes += (sizes.empty() ? "" : ", ") + part.name + " " + Kilobytes(part.bytes);
    }
    remarks.push_back("report " + Kilobytes(html.size()) + ": " + sizes);
    if (!pictures_beside.empty()) {
      std::size_t bytes = 0;
      for (const ReportFile& file : pictures_beside) bytes += file.bytes.size();
      remarks.push_back("beside it, in " + PictureFolder(files.html).string() + ": " +
                        std::to_string(pictures_beside.size()) + " files, " + Kilobytes(bytes));
    }
    for (const std::string& warning : report->warnings) remarks.push_back("warning: " + warning);
  }
  if (!files.sheet.empty()) {
    auto svg = BuildSheetSvg(run, sheet_frames, {.file_name = FileName(episode_path)});
    if (!svg) return svg.error();
    auto png = SvgToPng(*svg, files.sheet_scale);
    if (!png) return png.error();
    sheet = std::move(*png);
  }
  if (!files.html.empty()) {
    // The page comes last: it is never there without what it names.
    if (!pictures_beside.empty()) {
      if (Status written = WritePictures(PictureFolder(files.html), pictures_beside); !written)
        return written;
    }
    if (Status written = WriteFile(files.html, html); !written) return written;
  }
  if (!files.sheet.empty()) {
    if (Status written = WriteFile(files.sheet, sheet); !written) return written;
  }
  for (const std::string& remark : remarks) progress.Keep(remark);
  return Ok();
}

}  // namespace aerascope
