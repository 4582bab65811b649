// The inert blocks of a page: bytes that a browser keeps as text and does not look into until the script
// asks for them.
//
// A block is a <script> of a type no browser runs, with base64 inside; large ones are compressed first.
// Blocks stand in the order in which they were added; one with the id of an earlier one is left out, so what
// is named by its content is stored once.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "engine/base/result.h"

namespace aerascope {

class PageBlocks {
 public:
  // As they are; for what is compressed already.
  void Add(const std::string& part, const std::string& id, std::string_view mime, std::string_view bytes);
  // Not in the page but in a file beside it: the block only says where.
  void AddFile(const std::string& part, const std::string& id, std::string_view mime,
               const std::string& path);
  // Compressed with gzip.
  Status AddPacked(const std::string& part, const std::string& id, std::string_view mime,
                   std::string_view bytes);

  const std::string& html() const { return html_; }
  // Bytes of the page that each part takes, by the part's name.
  const std::map<std::string, std::size_t>& parts() const { return parts_; }

 private:
  void Write(const std::string& part, const std::string& id, std::string_view mime, bool packed,
             std::string_view bytes);

  std::string html_;
  std::map<std::string, std::size_t> parts_;
  std::map<std::string, std::string> part_of_;  // by the block's id
};

}  // namespace aerascope
