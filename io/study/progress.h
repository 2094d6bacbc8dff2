#pragma once

#include <cstddef>
#include <functional>

namespace volumen {

/// Called now and then with what is being done ("reading headers"), how many of how many. From the calling
/// thread.
using Progress = std::function<void(const char* what, std::size_t done, std::size_t total)>;

}  // namespace volumen
