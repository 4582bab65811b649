#include "viewer/page/page_template.h"

#include "viewer/page/encoding.h"

namespace aerascope {

std::string ContentPolicy(std::string_view script_sha256, std::string_view style_sha256, bool beside) {
  return "default-src 'none'; script-src 'sha256-" + Base64(BytesOfHex(script_sha256)) +
         "'; style-src 'sha256-" + Base64(BytesOfHex(style_sha256)) +
         "'; img-src blob: data:" + (beside ? " 'self'" : "") +
         "; media-src blob:" + (beside ? " 'self'" : "") + "; base-uri 'none'; form-action 'none'";
}

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

}  // namespace aerascope
