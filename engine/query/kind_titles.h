// What people call the kinds of events. The names in event_body.h are for programs and stay as they are.
#pragma once

#include <string_view>

namespace aerascope {

// "Goal reached" for "GoalAchieved"; empty for a name that is no kind's.
std::string_view KindTitle(std::string_view kind);

}  // namespace aerascope
