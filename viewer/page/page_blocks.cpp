#include "viewer/page/page_blocks.h"

#include "engine/base/markup.h"
#include "viewer/page/encoding.h"

namespace aerascope {

void PageBlocks::Add(const std::string& part, const std::string& id, std::string_view mime,
                     std::string_view bytes) {
  if (!part_of_.contains(id)) Write(part, id, mime, false, bytes);
}

void PageBlocks::AddFile(const std::string& part, const std::string& id, std::string_view mime,
                         const std::string& path) {
  if (!part_of_.try_emplace(id, part).second) return;
  const std::size_t before = html_.size();
  html_ += "<script type=\"application/octet-stream\" id=\"" + EscapeMarkup(id) + "\" data-type=\"" +
           EscapeMarkup(mime) + "\" data-file=\"" + EscapeMarkup(path) + "\"></script>\n";
  parts_[part] += html_.size() - before;
}

Status PageBlocks::AddPacked(const std::string& part, const std::string& id, std::string_view mime,
                             std::string_view bytes) {
  if (part_of_.contains(id)) return {};
  auto packed = Gzip(bytes);
  if (!packed) return packed.error();
  Write(part, id, mime, true, *packed);
  return {};
}

void PageBlocks::Write(const std::string& part, const std::string& id, std::string_view mime, bool packed,
                       std::string_view bytes) {
  const std::size_t before = html_.size();
  html_ += "<script type=\"application/octet-stream\" id=\"" + EscapeMarkup(id) + "\" data-type=\"" +
           EscapeMarkup(mime) + "\"" + (packed ? " data-packed=\"gzip\"" : "") + ">" + Base64(bytes) +
           "</script>\n";
  parts_[part] += html_.size() - before;
  part_of_[id] = part;
}

}  // namespace aerascope
