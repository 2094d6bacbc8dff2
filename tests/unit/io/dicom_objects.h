#pragma once

#include <functional>
#include <string>
#include <vector>

class DcmItem;

namespace volumen::tests {

/// SOP classes of objects that refer to pictures.
inline constexpr const char *presentationClass = "1.2.840.10008.5.1.4.1.1.11.1",
                            *keyObjectClass = "1.2.840.10008.5.1.4.1.1.88.59",
                            *reportClass = "1.2.840.10008.5.1.4.1.1.88.33",
                            *structureSetClass = "1.2.840.10008.5.1.4.1.1.481.3",
                            *segmentationClass = "1.2.840.10008.5.1.4.1.1.66.4";

/// Writes an object of this class with what `edit` puts in, in implicit VR little endian where `implicitVr`.
void writeObject(const std::string& path, const char* sopClassUid, const std::function<void(DcmItem&)>& edit,
                 bool implicitVr = false);

/// A new last item of a sequence, which is made where it is not there.
DcmItem& addItem(DcmItem& in, unsigned group, unsigned element);
/// Puts in text; numbers of FL.
void put(DcmItem& in, unsigned group, unsigned element, const std::string& value);
void putFloats(DcmItem& in, unsigned group, unsigned element, const std::vector<float>& values);
void putWord(DcmItem& in, unsigned group, unsigned element, unsigned value);

}  // namespace volumen::tests
