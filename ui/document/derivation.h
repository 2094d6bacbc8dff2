#pragma once

#include <QElapsedTimer>
#include <QObject>
#include <algorithm>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ui/data/series_pool.h"
#include "ui/document/job_lane.h"
#include "viewer/volume/result.h"

namespace volumen {

/// Declares the signals of derivations, as templates cannot have any.
class DerivationSignals : public QObject {
  Q_OBJECT
 public:
  using QObject::QObject;

 Q_SIGNALS:
  /// A value is ready, could not be computed, or was dropped.
  void changed();
  /// A value cannot be computed; the sentence says why. Sent once until a version of the value is ready.
  void failed(const QString& sentence);
  /// The user cancelled.
  void cancelled();
};

/// Values of one kind that follow from the document. `Key` holds all inputs of a value. Whenever the document
/// changes, update() compares the keys that it needs with what is there. It computes missing values on a
/// lane, one at a time and the most needed first, and cancels what is no longer needed. Readers find values
/// by key and hold none. A failure, lack of memory included, holds until the key changes or tryAgain().
template <class Key, class Value>
class Derivation : public DerivationSignals {
 public:
  using ValuePtr = std::shared_ptr<const Value>;
  using Work = std::function<Result<ValuePtr>(const Job&)>;

  /// What is there for a key. Without a value, `whyNot` is a sentence.
  struct Entry {
    Key key;
    ValuePtr value{};
    std::string whyNot{};
    bool isCancelled = false;   ///< whether the user cancelled it
    bool isTriedAgain = false;  ///< whether a failure no longer holds
  };

  struct Rule {
    /// Returns the keys of the values that the document needs, most needed first.
    std::function<std::vector<Key>()> wanted;
    /// Returns the computation of a value of at most `room` bytes, which runs on the lane.
    std::function<Work(const Key&, std::size_t room)> work;
    /// Returns the name of the job; an empty one is not listed.
    std::function<JobName(const Key&)> name;
    std::function<std::size_t(const Value&)> bytes;
    /// Returns whether two keys are versions of the same value. The old version stays until the new one is
    /// ready.
    std::function<bool(const Key&, const Key&)> areVersions = std::equal_to<Key>();
    /// Returns whether a value that is not wanted stays while there is room.
    std::function<bool(const Key&)> isKept = [](const Key&) { return false; };
    /// Returns true while nothing may begin or end, as during a stroke.
    std::function<bool()> isPaused = [] { return false; };
    /// Returns the sentence that reports a failure.
    std::function<QString(const Key&, const std::string& whyNot)> failure =
        [](const Key&, const std::string& whyNot) { return QString::fromStdString(whyNot); };
    std::string lacksMemory;     ///< the reason if memory ran out
    std::string wasCancelled{};  ///< the reason if the user cancelled
    std::size_t mostBytes = std::size_t(-1);
  };

  Derivation(Rule rule, Jobs* list, std::shared_ptr<SeriesPool> pool)
      : rule_(std::move(rule)), pool_(std::move(pool)), lane_(list) {}
  ~Derivation() override { pool_->count(this, 0); }

  const std::vector<Entry>& entries() const { return entries_; }
  /// Returns the entry of exactly this key, or null.
  const Entry* find(const Key& key) const {
    const auto at = std::ranges::find(entries_, key, &Entry::key);
    return at == entries_.end() ? nullptr : &*at;
  }
  bool isBusy() const { return lane_.isBusy(); }

  /// Compares what is needed with what is there. To be called whenever an input may have changed.
  void update() {
    if (rule_.isPaused()) return;
    const std::vector<Key> wanted = rule_.wanted();
    if (lane_.isBusy() && std::ranges::find(wanted, *underWay_) == wanted.end()) lane_.giveUpAll();
    drop([&](const Entry& entry) { return !isNeeded(entry, wanted) && !rule_.isKept(entry.key); });
    if (lane_.isBusy()) return;
    const auto next = std::ranges::find_if(wanted, [&](const Key& key) { return isMissing(key); });
    if (next != wanted.end()) begin(*next);
  }

  /// Lets the failures of these keys be tried again at the next update().
  void tryAgain(const std::function<bool(const Key&)>& isOne) {
    for (Entry& entry : entries_)
      entry.isTriedAgain = entry.isTriedAgain || (!entry.value && isOne(entry.key));
  }

 private:
  static constexpr int restMs = 200;  // least time between two changed() while more values are computed

  bool isMissing(const Key& key) const {
    const Entry* entry = find(key);
    return !entry || entry->isTriedAgain;
  }
  bool isNeeded(const Entry& entry, const std::vector<Key>& wanted) const {
    return std::ranges::any_of(wanted, [&](const Key& key) { return rule_.areVersions(key, entry.key); });
  }

  std::size_t bytesBeside(const Key* key) const {
    std::size_t bytes = 0;
    for (const Entry& entry : entries_)
      if (entry.value && !(key && rule_.areVersions(entry.key, *key))) bytes += rule_.bytes(*entry.value);
    return bytes;
  }

  bool drop(const std::function<bool(const Entry&)>& isGone) {
    if (std::erase_if(entries_, isGone) == 0) return false;
    tellChanged();
    return true;
  }

  void tellChanged() {
    told_.start();
    pool_->count(this, bytesBeside(nullptr));
    Q_EMIT changed();
  }

  void begin(const Key& key) {
    underWay_ = key;
    const std::size_t beside = bytesBeside(&key);
    lane_.run(
        rule_.name(key),
        [work = rule_.work(key, rule_.mostBytes - std::min(rule_.mostBytes, beside)),
         lacksMemory = rule_.lacksMemory](const Job& job) {
          return orNoMemory([&] { return work(job); }, lacksMemory);
        },
        [this, key](const Result<ValuePtr>& made) { take(key, made); }, [this] { takeCancelled(); });
  }

  // If a computation fails, values that are not needed are dropped and it is tried once more.
  void take(const Key& key, const Result<ValuePtr>& made) {
    if (!made) {
      const std::vector<Key> wanted = rule_.wanted();
      if (drop([&](const Entry& entry) { return entry.value && !isNeeded(entry, wanted); })) return update();
    }
    const bool isNews = !made && std::ranges::none_of(entries_, [&](const Entry& entry) {
      return !entry.value && !entry.isCancelled && rule_.areVersions(entry.key, key);
    });
    put(made ? Entry{key, *made} : Entry{key, nullptr, made.message()});
    update();
    if (!lane_.isBusy() || !told_.isValid() || told_.elapsed() > restMs) tellChanged();
    if (isNews) Q_EMIT failed(rule_.failure(key, made.message()));
  }

  // Marks all missing values as cancelled, so that one click cancels them all.
  void takeCancelled() {
    for (const Key& key : rule_.wanted())
      if (isMissing(key)) put({key, nullptr, rule_.wasCancelled, true});
    tellChanged();
    Q_EMIT cancelled();
  }

  void put(Entry entry) {
    std::erase_if(entries_, [&](const Entry& old) { return rule_.areVersions(old.key, entry.key); });
    entries_.push_back(std::move(entry));
  }

  const Rule rule_;
  const std::shared_ptr<SeriesPool> pool_;
  std::vector<Entry> entries_;
  std::optional<Key> underWay_;  // the last one begun
  QElapsedTimer told_;           // since changed()
  JobLane lane_;
};

}  // namespace volumen
