#pragma once

#include <algorithm>
#include <initializer_list>
#include <vector>

#include "ui/workspace/shared.h"

namespace volumen {

/// A std::vector whose copies share it and each element that none of them edited. It is read like a vector.
/// Functions that write have names of their own.
template <class T>
class SharedList {
 public:
  using value_type = T;
  using const_iterator = SharedIterator<T>;

  SharedList() = default;
  SharedList(std::initializer_list<T> items) { assign(items); }
  /// Holds `count` times T{}.
  explicit SharedList(std::size_t count) { items_.edit().resize(count); }

  const_iterator begin() const { return const_iterator(items_->data()); }
  const_iterator end() const { return const_iterator(items_->data() + items_->size()); }
  std::size_t size() const { return items_->size(); }
  bool empty() const { return items_->empty(); }
  const T& operator[](std::size_t n) const { return *(*items_)[n]; }
  const T& at(std::size_t n) const { return *items_->at(n); }
  const T& front() const { return *items_->front(); }
  const T& back() const { return *items_->back(); }

  /// Returns an element for writing. Copies the list and this element if others hold them too. Valid until
  /// this is copied or changes its length.
  T& edit(std::size_t n) { return items_.edit()[n].edit(); }

  void push_back(T item) { items_.edit().emplace_back(std::move(item)); }
  void clear() { items_ = {}; }
  template <class Items>
  void assign(const Items& items) {
    clear();
    for (const T& item : items) push_back(item);
  }
  void erase(const_iterator at) {
    const std::ptrdiff_t n = at - begin();
    auto& items = items_.edit();
    items.erase(items.begin() + n);
  }
  /// Changes the elements for which `isIt` holds.
  template <class IsIt, class Change>
  void editIf(const IsIt& isIt, const Change& change) {
    for (std::size_t n = 0; n < size(); ++n)
      if (isIt((*this)[n])) change(edit(n));
  }
  /// Erases the elements for which `isIt` holds. Returns whether there were any.
  template <class IsIt>
  bool eraseIf(const IsIt& isIt) {
    if (std::none_of(begin(), end(), isIt)) return false;
    std::erase_if(items_.edit(), [&](const Shared<T>& item) { return isIt(*item); });
    return true;
  }

  bool operator==(const SharedList&) const = default;

 private:
  Shared<std::vector<Shared<T>>> items_;
};

}  // namespace volumen
