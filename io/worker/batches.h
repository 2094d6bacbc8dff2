#pragma once

#include <algorithm>

#include "io/dicom/parallel.h"
#include "io/worker/call.h"

namespace volumen::worker {

/// Returns a request for reading the headers of `files` one after the other, with the limits they need.
Request headersOf(std::vector<std::string> files, const CancelToken& cancel);

/// Reads the files `begin` to `end` - 1 in one request, as workers answer faster than they are asked. A file
/// that costs a worker is refused and the others are requested again. Files that cost one before are refused
/// at once. If no worker can be had, none of the files is read.
template <auto function, class Values, class Refuse>
void askFor(const std::vector<std::string>& paths, std::size_t begin, std::size_t end,
            const CancelToken& cancel, const Refuse& refuse, Values& all) {
  if (begin == end || cancel.cancelled()) return;
  const auto leaveOut = [&](std::size_t costly, Failure why) {
    all[costly] = refuse(why);
    askFor<function>(paths, begin, costly, cancel, refuse, all);
    askFor<function>(paths, costly + 1, end, cancel, refuse, all);
  };
  if (isolating())
    for (std::size_t n = begin; n < end; ++n)
      if (const Failure why = costBefore(&answerWith<function>, paths[n]); why != Failure::none)
        return leaveOut(n, why);
  const std::vector<std::string> some(paths.begin() + std::ptrdiff_t(begin),
                                      paths.begin() + std::ptrdiff_t(end));
  Request request = headersOf(some, cancel);
  Failure failure{};
  Result<Values> values = isolated<function>(request, failure, some);
  if (values && values->size() == some.size()) {
    std::ranges::move(*values, all.begin() + std::ptrdiff_t(begin));
    return;
  }
  if (values) failure = Failure::wrong;
  if (failure == Failure::cancelled) return;
  if (isOfMachine(failure) && failure != Failure::killed) {
    for (std::size_t n = begin; n < end; ++n) all[n] = refuse(failure);
    return;
  }
  const std::size_t costly = begin + std::min<std::size_t>(request.stepsDone, some.size() - 1);
  rememberCost(&answerWith<function>, paths[costly], failure);
  leaveOut(costly, failure);
}

/// Returns function(paths), one value a file, computed on all cores and in workers if there are any.
/// `function` must call finishStep() after each file. refuse(why) gives the value of a file that was not
/// read.
template <auto function, class Refuse>
auto forFiles(const std::vector<std::string>& paths, const char* what, const Progress& progress,
              const CancelToken& cancel, const Refuse& refuse) {
  constexpr std::size_t most = mostDescriptors - 1;
  typename Signature<decltype(function)>::Value all(paths.size());
  const auto files = [&](const char* doing, std::size_t done, std::size_t) {
    progress(doing, std::min(done * most, paths.size()), paths.size());
  };
  dicom::forEachParallel((paths.size() + most - 1) / most, what, progress ? Progress(files) : Progress(),
                         cancel, [&](std::size_t n) {
                           askFor<function>(paths, n * most, std::min(paths.size(), (n + 1) * most), cancel,
                                            refuse, all);
                         });
  return all;
}

}  // namespace volumen::worker
