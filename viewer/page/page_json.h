// JSON as it goes into the page. Text of an episode is any bytes and of any length: what is not UTF-8 is
// replaced rather than refused, and what nobody would read to its end is cut and says how long it is.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "viewer/page/shortened.h"

namespace aerascope {

inline constexpr std::size_t kLongestPageText = 2000;

inline void ShortenTexts(nlohmann::json* value) {
  if (value->is_string()) {
    const auto& text = value->get_ref<const std::string&>();
    if (text.size() > kLongestPageText) *value = Shortened(text, kLongestPageText);
  } else if (value->is_structured()) {
    for (nlohmann::json& item : *value) ShortenTexts(&item);
  }
}

inline std::string PageJson(nlohmann::json value) {
  ShortenTexts(&value);
  return value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace aerascope
