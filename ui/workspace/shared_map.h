#pragma once

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "ui/workspace/shared.h"

namespace volumen {

/// A std::map whose copies share it and each entry that none of them edited. It is read like a map. Functions
/// that write have names of their own, so that reading copies nothing.
template <class Key, class T>
class SharedMap {
 public:
  using value_type = std::pair<const Key, T>;
  using const_iterator = SharedIterator<value_type>;

  const_iterator begin() const { return const_iterator(entries_->data()); }
  const_iterator end() const { return const_iterator(entries_->data() + entries_->size()); }
  std::size_t size() const { return entries_->size(); }
  bool empty() const { return entries_->empty(); }

  const_iterator find(const Key& key) const {
    const std::size_t n = placeOf(key);
    return holds(n, key) ? const_iterator(entries_->data() + n) : end();
  }
  bool contains(const Key& key) const { return holds(placeOf(key), key); }
  /// Throws std::out_of_range if the key is missing, as std::map does.
  const T& at(const Key& key) const { return (*entries_)[placeOfKnown(key)]->second; }

  /// Returns a value for writing. Copies the list of entries and this entry if others hold them too. Valid
  /// until this is copied or the entry is erased. Throws std::out_of_range if the key is missing.
  T& edit(const Key& key) {
    const std::size_t n = placeOfKnown(key);
    return entries_.edit()[n].edit().second;
  }
  /// Does the same, and adds `first` if the key is missing.
  T& editOrAdd(const Key& key, const T& first = {}) {
    add(key, first);
    return edit(key);
  }
  /// Adds an entry unless the key is there. Returns whether it did.
  bool add(const Key& key, const T& value) {
    const std::size_t n = placeOf(key);
    if (holds(n, key)) return false;
    auto& entries = entries_.edit();
    entries.insert(entries.begin() + std::ptrdiff_t(n), Shared<value_type>({key, value}));
    return true;
  }
  /// Erases an entry. Returns whether it was there.
  bool erase(const Key& key) {
    const std::size_t n = placeOf(key);
    if (!holds(n, key)) return false;
    auto& entries = entries_.edit();
    entries.erase(entries.begin() + std::ptrdiff_t(n));
    return true;
  }
  void clear() { entries_ = {}; }
  /// Changes the values of the entries for which `isIt` holds.
  template <class IsIt, class Change>
  void editIf(const IsIt& isIt, const Change& change) {
    for (std::size_t n = 0; n < size(); ++n)
      if (isIt(*(*entries_)[n])) change(entries_.edit()[n].edit().second);
  }

  bool operator==(const SharedMap&) const = default;

 private:
  // Returns the index of the first entry that is not before `key`.
  std::size_t placeOf(const Key& key) const {
    const auto isBefore = [](const Shared<value_type>& entry, const Key& k) { return entry->first < k; };
    return std::size_t(std::lower_bound(entries_->begin(), entries_->end(), key, isBefore) -
                       entries_->begin());
  }
  bool holds(std::size_t n, const Key& key) const {
    return n < entries_->size() && !(key < (*entries_)[n]->first);
  }
  std::size_t placeOfKnown(const Key& key) const {
    const std::size_t n = placeOf(key);
    if (!holds(n, key)) throw std::out_of_range("SharedMap");
    return n;
  }

  Shared<std::vector<Shared<value_type>>> entries_;  // sorted by key
};

}  // namespace volumen
