#pragma once

#include <cstddef>
#include <functional>

namespace volumen {

/// Reports `done` of `total` items of the activity `what` ("reading headers"). Called now and then, on the
/// calling thread.
using Progress = std::function<void(const char* what, std::size_t done, std::size_t total)>;

}  // namespace volumen
