#pragma once

#include <cstddef>
#include <functional>

namespace volumen {

/// Called now and then from the calling thread with the current activity and the numbers of finished and of
/// all items.
using StudyProgress = std::function<void(const char* what, std::size_t done, std::size_t total)>;

}  // namespace volumen
