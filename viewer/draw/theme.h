// The colours of all drawings, light and dark, and the style sheet that drawings refer to by class.
//
// Grey is context; blue (`ask`) is what the reader asked about; red and green tints are the two sides of a
// model; orange-red is failure. The values are CSS colours, so that a page may give its own variables:
// "var(--ink)".
#pragma once

#include <string>

namespace aerascope {

struct Theme {
  std::string surface, sunk, background;  // panes; past time and table bands; page
  std::string line, edge, mark;           // hairlines; outlines of cards and bars; grey signs
  std::string ink, ink2, ink3;            // text; secondary text; notes and ids
  std::string ask, ask_soft;              // what was asked about
  std::string lhs, lhs_edge;              // left side of a model
  std::string rhs, rhs_edge;              // right side of a model
  std::string simulated;                  // what happened only in the head
  std::string fail, fail_soft;            // a failed goal or prediction
};

Theme LightTheme();
Theme DarkTheme();

// CSS rules for the classes that the drawing functions of this folder use; all begin with "d-".
std::string DrawingStyle(const Theme& theme);

}  // namespace aerascope
