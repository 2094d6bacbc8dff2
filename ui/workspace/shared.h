#pragma once

#include <QSharedData>
#include <cstddef>
#include <iterator>
#include <utility>

namespace volumen {

/// A value that copies share until one of them is edited (copy on write). Copying and comparing copies cost
/// nothing. Copies may be read and dropped on other threads. Reading never copies; only edit() does.
template <class T>
class Shared {
 public:
  Shared() = default;
  explicit Shared(T value) : held_(new Held(std::move(value))) {}

  const T& operator*() const { return held_ ? held_->value : none(); }
  const T* operator->() const { return &**this; }

  /// Returns the value for writing, as a copy if others hold it too. Valid until this is copied.
  T& edit() {
    if (!held_)
      held_ = new Held(T());
    else if (held_->ref.loadAcquire() != 1)
      held_ = new Held(T(held_->value));
    return held_->value;
  }

  /// Returns whether both hold the same object, not only an equal one.
  bool sharesWith(const Shared& other) const { return held_ == other.held_; }
  bool operator==(const Shared& other) const { return sharesWith(other) || **this == *other; }

 private:
  struct Held : QSharedData {
    explicit Held(T v) : value(std::move(v)) {}
    T value;
  };

  static const T& none() {
    static const T value{};
    return value;
  }

  QExplicitlySharedDataPointer<Held> held_;  // null: T{}
};

/// Iterates over shared values as over plain values.
template <class T>
class SharedIterator {
 public:
  using iterator_category = std::bidirectional_iterator_tag;
  using value_type = T;
  using difference_type = std::ptrdiff_t;
  using pointer = const T*;
  using reference = const T&;

  SharedIterator() = default;
  explicit SharedIterator(const Shared<T>* at) : at_(at) {}

  const T& operator*() const { return **at_; }
  const T* operator->() const { return &**at_; }
  SharedIterator& operator++() {
    ++at_;
    return *this;
  }
  SharedIterator operator++(int) { return SharedIterator(at_++); }
  SharedIterator& operator--() {
    --at_;
    return *this;
  }
  SharedIterator operator--(int) { return SharedIterator(at_--); }
  difference_type operator-(const SharedIterator& other) const { return at_ - other.at_; }
  bool operator==(const SharedIterator&) const = default;

 private:
  const Shared<T>* at_ = nullptr;
};

}  // namespace volumen
