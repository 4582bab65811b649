#include "engine/store/empty_episode.h"

// The assembler takes the bytes in as they are; a page of SQLite begins at a multiple of 8.
asm(R"(
  .section .rodata
  .balign 16
aerascope_empty_episode_begin:
  .incbin ")" AERASCOPE_EMPTY_EPISODE R"("
aerascope_empty_episode_end:
  .byte 0
  .text
)");

extern "C" {
extern const std::byte aerascope_empty_episode_begin;
extern const std::byte aerascope_empty_episode_end;
}

namespace aerascope {

std::span<const std::byte> EmptyEpisodeImage() {
  return {&aerascope_empty_episode_begin, &aerascope_empty_episode_end};
}

}  // namespace aerascope
