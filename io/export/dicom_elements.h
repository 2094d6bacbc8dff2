#pragma once

#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <vector>

class DcmItem;

namespace volumen {

/// An element of a data set as text, on its way into a file. In a list, what a sequence holds stands behind
/// it: each item is headed by an element dicomItem, and the depth counts items.
struct DicomElement {
  std::uint32_t tag = 0;  ///< group << 16 | element
  std::string value;      ///< UTF-8, several values between backslashes; numbers in decimals
  std::uint16_t vr = 0;   ///< first letter << 8 | second; 0: what the dictionary says
  int depth = 0;
  bool operator==(const DicomElement&) const = default;
};
using DicomElements = std::vector<DicomElement>;

inline constexpr std::uint32_t dicomItem = 0xfffee000;

inline void append(DicomElements& all, const DicomElements& more) {
  all.insert(all.end(), more.begin(), more.end());
}

/// The decimal string (VR DS, at most 16 characters) nearest to a number, as short as says the same.
std::string decimal(double value);
/// Several of them, between backslashes.
std::string decimals(std::initializer_list<double> values);

/// The value of an element of the list itself; empty where it is not there.
std::string valueOf(std::span<const DicomElement> elements, std::uint32_t tag);

/// Puts elements into a data set, over what is there; an empty value takes no other's place. Elements that
/// cannot be written (a VR that is not known, a number that is none) are left out.
void put(std::span<const DicomElement> elements, DcmItem& into);

}  // namespace volumen
