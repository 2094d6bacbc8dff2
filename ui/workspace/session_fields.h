#pragma once

#include <string>
#include <vector>

#include "io/study/series_key.h"
#include "ui/workspace/shared_list.h"
#include "ui/workspace/shared_map.h"
#include "viewer/measure/shape.h"
#include "viewer/recipe/recipe.h"
#include "viewer/scene/fields.h"
#include "viewer/scene/scene.h"

namespace volumen {

struct Series;

inline constexpr Limits mmLimits{-1e9, 1e9};
inline constexpr Limits valueLimits{-1e33, 1e33};  ///< volumes hold up to 1e30

/// The series of a session. Everything after their list refers to them by index in it, from 0.
struct NumberedSeries {
  std::vector<SeriesKey> keys;
  std::vector<std::string> frames;  ///< the frame of reference of a series without a UID for it; else empty

  void add(const Series& series);
};

/// The steps of a segment map that cannot be read, and why: a sentence about one step.
struct UnreadSteps {
  SeriesKey series;
  int map;  ///< number of the map
  std::string why;
};

/// What the fields of a session refer to: the series, and the list of steps that could not be read.
struct SessionContext {
  const NumberedSeries* series;
  std::vector<UnreadSteps>* unread = nullptr;  ///< only for reading
};
using SessionFields = FieldsWith<SessionContext>;

/// Reads or writes the index of a series in the list, null for no series.
void field(SessionFields& f, const char* name, SeriesKey& series);
void field(SessionFields& f, const char* name, Scene& scene);
void field(SessionFields& f, const char* name, Shape& shape);
/// Reads or writes a frame of reference: its UID, or the index of the only series in it.
void frameField(SessionFields& f, const char* name, std::string& frame);
/// Reads or writes how the segments of a map were made, as in a recipe; nothing if that is unknown. Steps
/// that cannot be read are no error: they are left out and listed in the context.
void stepsField(SessionFields& f, const SeriesKey& series, int map, const char* name,
                std::vector<Step>& steps);

template <class T>
void field(SessionFields& f, const char* name, SharedList<T>& items) {
  std::vector<T> list(items.begin(), items.end());
  f(name, list);
  if (f.reading()) items.assign(list);
}

/// Reads or writes a map as a list of objects, each with the fields that `fieldsOf(f, key, value)` names.
template <class Key, class T, class FieldsOf>
void mapField(SessionFields& f, const char* name, SharedMap<Key, T>& items, FieldsOf fieldsOf) {
  std::vector<std::pair<Key, T>> list;
  if (!f.reading()) list.assign(items.begin(), items.end());
  f.list(name, list, {},
         [&](SessionFields& item, auto& entry) { fieldsOf(item, entry.first, entry.second); });
  for (std::size_t n = 0; f.reading() && n < list.size(); ++n)
    if (!items.add(list[n].first, list[n].second)) f.refuse(f.pathOf(name, n), "is there twice");
}

}  // namespace volumen
