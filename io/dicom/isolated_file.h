#pragma once

#include "io/dicom/object_check.h"
#include "io/worker/batches.h"

namespace volumen::dicom {

/// Returns isolatedFile() and reports how much of a picture is read.
template <auto read, class... More>
auto isolatedPicture(const std::string& path, std::uint64_t pixels, const Progress& progress,
                     const More&... more) {
  constexpr std::uint64_t bytesAPixel = 4, bytesAnswered = 24;
  const CancelToken never;
  worker::Request request = worker::headersOf({path}, never);
  request.needBytes += bytesAPixel * pixels;
  request.mostBytes += bytesAnswered * pixels;
  request.progress = progress;
  worker::Failure failure{};
  auto result = worker::isolated<read>(request, failure, path, more...);
  if (result && worker::isolating() && !isConsistent(*result)) failure = worker::Failure::wrong;
  if (failure != worker::Failure::none) result = Error{path + ": " + reasonOf(failure, request) + "."};
  return result;
}

/// Returns read(path, more...), run in a worker if there are any (io/worker). `read` reads a DICOM file
/// without its pixels, or a frame of `pixels` pixels. An Error is read's own, or names the file and the fate
/// of the worker.
template <auto read, class... More>
auto isolatedFile(const std::string& path, std::uint64_t pixels, const More&... more) {
  return isolatedPicture<read>(path, pixels, Progress(), more...);
}

}  // namespace volumen::dicom
