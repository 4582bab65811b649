// How every page is put together: a template with places to fill, and the policy that says what it may do.
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace aerascope {

// A page may run its own script and use its own style, told by their hashes, show images and videos that it
// makes itself, and nothing else. `beside`: pictures and video are files beside the page.
std::string ContentPolicy(std::string_view script_sha256, std::string_view style_sha256, bool beside = false);

// The template with every @name@ replaced; a name without a value stays.
std::string Filled(std::string_view page, const std::map<std::string_view, std::string_view>& values);

}  // namespace aerascope
