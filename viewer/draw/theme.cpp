#include "viewer/draw/theme.h"

namespace aerascope {

Theme LightTheme() {
  return {.surface = "#ffffff",
          .sunk = "#f6f7f9",
          .background = "#f3f4f6",
          .line = "#dfe3e8",
          .edge = "#848e9c",
          .mark = "#5c6673",
          .ink = "#1a1f26",
          .ink2 = "#49525e",
          .ink3 = "#5f6976",
          .ask = "#0b5cc2",
          .ask_soft = "#e5effb",
          .lhs = "#fdeae7",
          .lhs_edge = "#b9524a",
          .rhs = "#e5f4e8",
          .rhs_edge = "#2f7d4f",
          .simulated = "#fdf6d8",
          .fail = "#b03a06",
          .fail_soft = "#fdeee4"};
}

Theme DarkTheme() {
  return {.surface = "#181c21",
          .sunk = "#1e2329",
          .background = "#101317",
          .line = "#2e353d",
          .edge = "#76818f",
          .mark = "#a3acb8",
          .ink = "#e9ecef",
          .ink2 = "#b7bfc9",
          .ink3 = "#949eab",
          .ask = "#79b2ff",
          .ask_soft = "#1b2d45",
          .lhs = "#3a2523",
          .lhs_edge = "#e08a80",
          .rhs = "#1c3325",
          .rhs_edge = "#72c295",
          .simulated = "#37321c",
          .fail = "#ff9c6b",
          .fail_soft = "#3b2519"};
}

std::string DrawingStyle(const Theme& t) {
  const std::string sans = "font-family:'DejaVu Sans',system-ui,sans-serif;";
  const std::string mono = "font-family:'DejaVu Sans Mono',ui-monospace,monospace;";
  return "text{" + sans + "font-size:12px;fill:" + t.ink + ";white-space:pre}" +                //
         ".d-2{fill:" + t.ink2 + "}.d-3{fill:" + t.ink3 + "}" +                                 //
         ".d-b{font-weight:bold}.d-v{font-style:italic}" +                                      //
         ".d-ask{fill:" + t.ask + "}.d-fail{fill:" + t.fail + "}" +                             //
         ".d-id{" + mono + "font-size:11px;fill:" + t.ink2 + "}" +                              //
         ".d-card{fill:" + t.surface + ";stroke:" + t.edge + "}" +                              //
         ".d-frame{fill:none;stroke:" + t.edge + "}" +                                          //
         ".d-gone{stroke-dasharray:3 3}" +                                                      //
         ".d-slot{fill:none;stroke:" + t.edge + ";stroke-dasharray:2 4}" +                      //
         ".d-chosen{stroke:" + t.ask + ";stroke-width:2}" +                                     //
         ".d-lhs{fill:" + t.lhs + "}.d-rhs{fill:" + t.rhs + "}" +                               //
         ".d-line{fill:none;stroke:" + t.line + "}" +                                           //
         ".d-link{fill:none;stroke:" + t.edge + ";stroke-width:1.25}" +                         //
         ".d-arrow{fill:" + t.edge + "}" +                                                      //
         ".d-cut{stroke:" + t.ink2 + ";stroke-width:1.25}" +                                    //
         ".d-derived{fill:none;stroke:" + t.ask + ";stroke-width:1.25;stroke-dasharray:4 3}" +  //
         ".d-derived-tip{fill:none;stroke:" + t.ask + ";stroke-width:1.25}" +                   //
         ".d-star{fill:" + t.ask + "}.d-mark{fill:" + t.mark + "}" +                            //
         ".d-ring{fill:" + t.surface + ";stroke:" + t.line + ";stroke-width:3}" +               //
         ".d-arc{fill:none;stroke:" + t.mark + ";stroke-width:3}" +                             //
         ".d-curve{fill:none;stroke:" + t.ask + ";stroke-width:2}" +                            //
         ".d-dot{fill:" + t.surface + ";stroke:" + t.ask + ";stroke-width:2}" +                 //
         ".d-cross{fill:none;stroke:" + t.fail + ";stroke-width:2}" +                           //
         ".d-check{fill:none;stroke:" + t.ink2 + ";stroke-width:1.5}" +                         //
         ".d-bar{fill:" + t.line + ";stroke:" + t.edge + "}" +                                  //
         ".d-teacher{fill:" + t.surface + ";stroke:" + t.edge + ";stroke-dasharray:3 2}" +      //
         ".d-failed{fill:" + t.fail_soft + ";stroke:" + t.fail + "}" +                          //
         ".d-found{fill:" + t.sunk + ";stroke:" + t.line + "}" +                                //
         ".d-veto{stroke:" + t.fail + "}" +                                                     //
         ".d-bars{fill:none;stroke:" + t.fail + ";stroke-width:2.5;stroke-linecap:round}" +     //
         ".d-sunk{fill:" + t.sunk + "}.d-page{fill:" + t.surface + "}";
}

}  // namespace aerascope
