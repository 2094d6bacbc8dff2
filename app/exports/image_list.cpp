#include "app/exports/image_list.h"

#include <algorithm>
#include <charconv>

namespace volumen {

namespace {

// Adds an image of the list, "UID" or "UID/FRAME". One that is named without frame stands for all frames.
Status addImage(const std::string& word, std::vector<ReferencedPicture>& all) {
  const std::size_t slash = word.find('/');
  const std::string uid = word.substr(0, slash);
  const Error wrong{"--images: \"" + word + "\" is not UID or UID/FRAME, with frames from 1."};
  if (uid.empty()) return wrong;
  auto known = std::ranges::find(all, uid, &ReferencedPicture::sopInstanceUid);
  const bool isNew = known == all.end();
  if (isNew) known = all.insert(all.end(), {uid, {}, {}, {}});
  if (slash == std::string::npos) return known->frames.clear(), Status();
  int frame = 0;
  const auto [end, error] = std::from_chars(word.data() + slash + 1, word.data() + word.size(), frame);
  if (error != std::errc() || end != word.data() + word.size() || frame < 1) return wrong;
  if (!isNew && known->frames.empty()) return {};
  known->frames.push_back(frame - 1);
  std::ranges::sort(known->frames);
  known->frames.erase(std::ranges::unique(known->frames).begin(), known->frames.end());
  return {};
}

}  // namespace

Result<std::vector<ReferencedPicture>> imagesIn(const std::string& list) {
  std::vector<ReferencedPicture> all;
  if (list.empty()) return all;
  for (std::size_t begin = 0; begin <= list.size();) {
    const std::size_t end = std::min(list.find(',', begin), list.size());
    if (Status s = addImage(list.substr(begin, end - begin), all); !s) return s.error();
    begin = end + 1;
  }
  return all;
}

}  // namespace volumen
