#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace volumen {

/// What the Basic Application Level Confidentiality Profile would remove and is kept (PS3.15 E.3).
struct Retained {
  bool uids = false;
  bool dates = false;        ///< as they are
  bool device = false;       ///< identity of the device
  bool institution = false;  ///< identity of the institution
  bool patient = false;      ///< characteristics of the patient: sex, age, size, weight
  bool descriptors = false;  ///< known words of descriptions (descriptor_words.h)
  bool privates = false;     ///< private attributes that are known to be safe (safe_private.h)
  int shiftDays = 0;         ///< not 0: dates are kept, moved by this number of days
  bool operator==(const Retained&) const = default;
};

/// What happens to an attribute. `shift` moves dates and keeps times of day; `clean` keeps known words.
enum class ProfileAction { keep, remove, empty, dummy, newUid, shift, clean };

/// The actions of the profile (PS3.15 table E.1-1, edition 2026c) with what is retained.
class ConfidentialityProfile {
 public:
  explicit ConfidentialityProfile(const Retained& retained);

  /// What happens to a standard attribute; those that the table does not list are kept. `isClassic`: in an
  /// image whose class needs no dates of series and acquisition, where the table leaves a choice.
  ProfileAction actionOf(std::uint32_t tag, bool isClassic) const;
  /// Returns the VR of an attribute of the table as in Element::vr, 0 if it lists none.
  std::uint16_t vrOf(std::uint32_t tag) const;

 private:
  struct Row {
    std::uint32_t tag, mask;
    std::uint16_t vr;
    ProfileAction classic, other;
  };
  const Row* rowOf(std::uint32_t tag) const;
  static Row rowFrom(std::string_view line, const Retained& retained);

  std::vector<Row> rows_;  // by tag; those with digits left open (50xx) behind the others
  std::size_t exact_ = 0;  // number of rows without open digits
};

}  // namespace volumen
