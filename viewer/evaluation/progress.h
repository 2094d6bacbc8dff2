#pragma once

#include <cstddef>
#include <functional>

namespace volumen {

/// Called now and then, from the calling thread, with what is being done and how many of how many are
/// finished.
using StudyProgress = std::function<void(const char* what, std::size_t done, std::size_t total)>;

}  // namespace volumen
