#pragma once
#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "undine/app/watchdog/evidence.hpp"
#include "undine/core/catalogue.hpp"

// A cause of a run going bad is a struct with
//   info      its name; what it is; the test in plain text; where the criterion comes from
//   holds     whether the evidence speaks for it
//   because   the numbers that do, for people
//   remedy    what to change
// all of them pure functions of the evidence. causes/catalogue.hpp lists them, the more specific first.
