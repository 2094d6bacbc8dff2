#include "ui/workspace/hanging_queue.h"

#include <algorithm>

#include "ui/workspace/patients.h"

namespace volumen {

namespace {

// Returns whether pictures of a study fulfil a condition.
template <class Condition>
bool hasPicture(const Study& study, const Condition& condition) {
  return std::ranges::any_of(study.volumes, condition) || std::ranges::any_of(study.images, condition);
}

bool mayHang(const HangingQueue& queue, const Workspace& workspace, const Series& opened) {
  if (isInSecond(workspace.focus)) return false;
  if (!comparesSeries(workspace.layout) || queue.layoutByItself == workspace.layout) return true;
  return std::ranges::any_of(patientsOnScreen(workspace),
                             [&](const Series* other) { return !areOfOnePatient(*other, opened); });
}

}  // namespace

HangingQueue withOpened(HangingQueue queue, const std::shared_ptr<const Study>& study,
                        const std::shared_ptr<const bool>& isAnyShown) {
  if (isAnyShown && (!*isAnyShown || isAnyShown == queue.together)) return queue;
  queue.together = isAnyShown;
  queue.awaited.push_back(study);
  return queue;
}

HangingQueue withoutSeries(HangingQueue queue, const SeriesKey& series) {
  std::erase_if(queue.awaited, [&](const std::shared_ptr<const Study>& study) {
    return std::ranges::any_of(study->volumes, [&](const Series& s) { return keyOf(s) == series; });
  });
  return queue;
}

HangingQueue withoutClosed(HangingQueue queue, const std::vector<const Series*>& open) {
  std::set<std::string> uids;
  for (const Series* series : open) uids.insert(series->studyUid);
  std::erase_if(queue.hungByItself, [&](const std::string& uid) { return !uids.contains(uid); });
  const auto isOpen = [&](const SeriesIdentity& s) { return uids.contains(s.studyUid); };
  std::erase_if(queue.awaited, [&](const auto& study) { return !hasPicture(*study, isOpen); });
  return queue;
}

HangingQueue withHung(HangingQueue queue, const HangingProtocol& protocol, const std::string& studyUid,
                      bool byItself) {
  queue.last = {protocol.name, studyUid};
  queue.layoutByItself = byItself ? std::optional(protocol.layout) : std::nullopt;
  return queue;
}

NextHanging nextHanging(HangingQueue queue, const Workspace& workspace,
                        const std::vector<const Series*>& open,
                        const std::vector<HangingProtocol>& protocols) {
  const Series* shown = seriesIn(workspace, workspace.focus);
  if (!shown || shown->studyUid.empty()) return {queue};
  const auto isOfIt = [&](const SeriesIdentity& s) { return s.studyUid == shown->studyUid; };
  const auto left =
      std::erase_if(queue.awaited, [&](const auto& study) { return hasPicture(*study, isOfIt); });
  if (left == 0 || !mayHang(queue, workspace, *shown)) return {queue};
  if (!queue.hungByItself.insert(shown->studyUid).second) return {queue};
  for (const std::size_t n : fitting(protocols, studiesAround(open, *shown)))
    if (protocols[n].automatic) return {queue, &protocols[n]};
  return {queue};
}

std::string lastNameFor(const LastProtocol& last, const std::string& studyUid) {
  return last.studyUid == studyUid ? last.name : std::string();
}

std::size_t indexFrom(const std::vector<const HangingProtocol*>& protocols, const std::string& last, int by) {
  const int count = int(protocols.size());
  const auto found = std::ranges::find(protocols, last, &HangingProtocol::name);
  const int from = found != protocols.end() ? int(found - protocols.begin()) : by > 0 ? -1 : count;
  return std::size_t((from + by + count) % count);
}

}  // namespace volumen
