#pragma once

#include <memory>
#include <set>

#include "io/study/study.h"
#include "ui/workspace/hanging_protocol.h"

namespace volumen {

/// The hanging protocol used last, and the study it was used for.
struct LastProtocol {
  std::string name, studyUid;
};

/// What is hung next: opened studies that are hung by themselves once they are shown, and what was hung
/// before.
struct HangingQueue {
  std::vector<std::shared_ptr<const Study>> awaited{};  ///< opened studies that were not shown yet
  std::shared_ptr<const bool> together{};  ///< `isAnyShown` of the study opened last (withOpened())
  std::set<std::string> hungByItself{};    ///< UIDs of open studies that were hung by themselves
  std::optional<Layout> layoutByItself{};  ///< layout of the last hanging, if that was by itself
  LastProtocol last{};
};

/// Returns the queue after a study was opened as a whole. Of several studies opened together only the first
/// one shown waits. `isAnyShown` tells them apart from other groups; null for a single study.
HangingQueue withOpened(HangingQueue queue, const std::shared_ptr<const Study>& study,
                        const std::shared_ptr<const bool>& isAnyShown);
/// Returns the queue without the study of a series that could not be loaded.
HangingQueue withoutSeries(HangingQueue queue, const SeriesKey& series);
/// Returns the queue without closed studies, so that they are hung again when reopened. `open` are all open
/// pictures.
HangingQueue withoutClosed(HangingQueue queue, const std::vector<const Series*>& open);
/// Returns the queue after a protocol was hung for a study, by itself or by the user.
HangingQueue withHung(HangingQueue queue, const HangingProtocol& protocol, const std::string& studyUid,
                      bool byItself);

/// What is to be hung by itself.
struct NextHanging {
  HangingQueue queue;
  const HangingProtocol* protocol = nullptr;  ///< null for none
};
/// Returns how the study in focus is hung if it waits, and the queue without it. Takes the first automatic
/// protocol that fits. Returns none if the study was hung before, is shown in the second window, or the
/// layout was chosen for its patient.
NextHanging nextHanging(HangingQueue queue, const Workspace& workspace,
                        const std::vector<const Series*>& open,
                        const std::vector<HangingProtocol>& protocols);

/// Returns the name of the protocol used last, or an empty text if that was for another study.
std::string lastNameFor(const LastProtocol& last, const std::string& studyUid);
/// Returns the index of the protocol `by` (1 or -1) places from the one named `last`, in a cycle. If there is
/// no such protocol, returns the first or, backwards, the last one. `protocols` are not empty.
std::size_t indexFrom(const std::vector<const HangingProtocol*>& protocols, const std::string& last, int by);

}  // namespace volumen
