#pragma once

#include <memory>
#include <optional>

#include "ui/workspace/workspace.h"

namespace volumen {

/// What was asked for and is not there yet. It is in no undo step and in no file.
struct Requests {
  /// A series that is read, also where it is in memory, and then shown.
  struct Show {
    std::shared_ptr<const Series> series;
    std::optional<Scene> scene{};
    bool operator==(const Show&) const = default;
  };
  std::optional<Show> show{};      ///< takes the view in focus; the latest request counts
  std::optional<Layout> layout{};  ///< for the modality of what is being opened

  /// Returns whether this series is to be shown.
  bool shows(const SeriesKey& key) const { return show && keyOf(*show->series) == key; }
  bool operator==(const Requests&) const = default;
};

}  // namespace volumen
