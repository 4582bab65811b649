// An episode file without events: all tables, and what every column means. It is made once, when the program
// is built (make_empty_episode.cpp), and each new file starts as a copy: to create sixty tables takes longer
// than to store a thousand events.
#pragma once

#include <cstddef>
#include <span>

namespace aerascope {

std::span<const std::byte> EmptyEpisodeImage();

}  // namespace aerascope
