#pragma once

#include <concepts>
#include <new>
#include <string>
#include <type_traits>
#include <utility>

#include "viewer/volume/result.h"

namespace volumen {

inline constexpr const char* outOfMemory =
    "There is not enough memory for this: close series that are not needed, then try again.";

/// Returns the result of `work`, or an Error with `sentence` if memory ran out.
template <class Work>
requires std::constructible_from<std::invoke_result_t<Work>, Error> std::invoke_result_t<Work> orNoMemory(
    Work&& work, const std::string& sentence = outOfMemory) {
  try {
    return std::forward<Work>(work)();
  } catch (const std::bad_alloc&) {
    return std::invoke_result_t<Work>(Error{sentence});
  }
}

}  // namespace volumen
