#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/dicom/bytes.h"
#include "viewer/volume/result.h"

namespace volumen::dicom {

/// How a data set is written (PS3.5 7.1, annex A).
struct Encoding {
  bool explicitVr = true;
  bool bigEndian = false;
};

/// The file meta information (PS3.10 7.1).
struct MetaHeader {
  bool magic = false;             ///< "DICM" at 128
  std::string transferSyntaxUid;  ///< (0002,0010), empty where it is missing
  std::uint64_t dataSet = 0;      ///< offset of the data set
};

/// One element, item or sequence as it lies in the bytes. Lists of elements are flat, in file order: what
/// element n holds (the items of a sequence, the elements of an item) are the entries n + 1 .. end - 1.
struct Element {
  std::uint32_t tag = 0;  ///< group << 16 | element
  std::uint16_t vr = 0;   ///< first letter << 8 | second; 0 where it is not written
  bool bigEndian = false;
  std::uint32_t end = 0;     ///< index of the entry behind all it holds
  std::uint64_t offset = 0;  ///< of its value
  std::uint64_t length = 0;  ///< of its value; undefinedLength where the file says so
};

inline constexpr std::uint64_t undefinedLength = 0xffffffff;
/// What delimits items and sequences (PS3.5 7.5).
inline constexpr std::uint32_t itemTag = 0xfffee000, itemEndTag = 0xfffee00d, sequenceEndTag = 0xfffee0dd;
inline constexpr std::uint16_t vrOf(char a, char b) { return std::uint16_t(a << 8 | b); }

/// What a pass over a data set found.
struct DataSetScan {
  std::vector<Element> elements;
  std::optional<Element> pixels;  ///< (7FE0,0008), (7FE0,0009) or (7FE0,0010): the pass ends there
  std::uint64_t needsUpTo = 0;    ///< not 0: the given bytes end too early; the pass needs at least these
};

/// "DICM" at 128.
bool hasMagic(Bytes head);

/// Reads the file meta information from the beginning of a file; `fileSize` bytes in all. Files without
/// preamble give magic = false and the place where their data set may begin. Limit: 1 MiB of meta header.
Result<MetaHeader> scanMeta(Bytes head, std::uint64_t fileSize);

/// How the data set at `offset` is written, by what its first element looks like; `expected` decides where
/// that leaves a choice.
Encoding encodingFound(Bytes head, std::uint64_t offset, Encoding expected);

/// One pass over a data set up to its pixel data, without recursion and without trusting a length: every
/// value ends inside its parent, depth <= 64, at most 1,000,000 elements and items, no group 0000. `head`:
/// the first bytes of `fileSize`. An Error says what is wrong and where; `before` is then what stands in
/// front.
Result<DataSetScan> scanDataSet(Bytes head, std::uint64_t offset, std::uint64_t fileSize, Encoding encoding,
                                DataSetScan* before = nullptr);

/// "(0028,0010)".
std::string tagText(std::uint32_t tag);

}  // namespace volumen::dicom
