// What the tests of drawings share: runs to draw, and a check of SVG by another reader than ours (xmllint).
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "engine/query/run.h"
#include "tests/support/paper_episode.h"

namespace aerascope {

// The paper's episode as a run.
Run PaperRun(const PaperEpisodeOptions& options = {});

// A run that learns `triads` pieces of knowledge in as many frames, three rows a causal model; the first one
// may be a veto.
Run LongRun(int triads, bool with_veto = false);

// "" if xmllint finds the text well-formed, else what it says; "xmllint is not installed" where it is not.
std::string WhatXmllintSays(const std::string& svg);
inline constexpr std::string_view kNoXmllint = "xmllint is not installed";

std::size_t CountOf(std::string_view text, std::string_view part);

}  // namespace aerascope
