#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace volumen {

/// The options of the Basic Application Level Confidentiality Profile (PS3.15 E.3). Each keeps something
/// that the profile removes by default.
struct Retained {
  bool uids = false;
  bool dates = false;        ///< dates and times, unchanged
  bool device = false;       ///< identity of the device
  bool institution = false;  ///< identity of the institution
  bool patient = false;      ///< characteristics of the patient: sex, age, size, weight
  bool descriptors = false;  ///< harmless words of descriptions (descriptor_words.h)
  bool privates = false;     ///< private attributes that are known to be safe (safe_private.h)
  int shiftDays = 0;         ///< days by which dates are moved; 0: dates are not moved
  bool operator==(const Retained&) const = default;
};

/// Says what the profile does with an attribute. `shift` moves dates and keeps times of day. `clean` keeps
/// only known words of a text.
enum class ProfileAction { keep, remove, empty, dummy, newUid, shift, clean };

/// The actions of the profile (PS3.15 table E.1-1, edition 2026c), changed by the options in Retained.
class ConfidentialityProfile {
 public:
  explicit ConfidentialityProfile(const Retained& retained);

  /// Returns the action for a standard attribute. Where the table leaves a choice, `isClassic` decides. It
  /// is true for images whose class needs no dates of series and acquisition (isClassicImage()). `vr` (as
  /// Element::vr) counts only for attributes that the table does not list: dates, times and UIDs among them
  /// are treated like those in the table, all others are kept.
  ProfileAction actionOf(std::uint32_t tag, bool isClassic, std::uint16_t vr = 0) const;
  /// Returns the VR of an attribute as Element::vr has it; 0 if the table does not list the attribute.
  std::uint16_t vrOf(std::uint32_t tag) const;

 private:
  struct Row {
    std::uint32_t tag, mask;
    std::uint16_t vr;
    ProfileAction classic, other;
  };
  const Row* rowOf(std::uint32_t tag) const;
  static Row rowFrom(std::string_view line, const Retained& retained);
  ProfileAction unlistedAction(std::uint32_t tag, std::uint16_t vr) const;

  Retained retained_;
  std::vector<Row> rows_;  // by tag; rows with open digits (50xx) come last
  std::size_t exact_ = 0;  // number of rows without open digits
};

}  // namespace volumen
