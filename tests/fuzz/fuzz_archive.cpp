// Fuzzes what archives answer by HTTP: a message in parts, its pieces cut by the first bytes, and a page of
// answers in JSON.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcdeftag.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "io/archive/data_sets.h"
#include "io/archive/multipart.h"
#include "io/archive/web_json.h"

using namespace volumen;

namespace {

class Parts : public PartSink {
 public:
  Status beginPart() override { return follows(false, true); }
  Status partData(std::string_view) override { return follows(true, true); }
  Status endPart() override { return follows(true, false); }

 private:
  // Parts begin and end in turn, and data lie between.
  Status follows(bool wasOpen, bool isOpen) {
    if (isOpen_ != wasOpen) std::abort();
    isOpen_ = isOpen;
    return {};
  }

  bool isOpen_ = false;
};

void readParts(std::string_view text) {
  Parts parts;
  const std::size_t piece = 1 + static_cast<std::uint8_t>(text.front());
  auto reader =
      MultipartReader::of(text.front() % 2 ? "multipart/related; boundary=b" : text.substr(1, 80), parts);
  for (std::size_t at = 1; reader && at < text.size(); at += piece)
    if (!reader->feed(text.substr(at, piece))) return;
}

void readPage(std::string_view text) {
  const auto page = nlohmann::json::parse(text, nullptr, false);
  if (!page.is_array()) return;
  DcmDataset keys = keysAt("STUDY");
  askFor(keys, {DCM_PatientName, DCM_PatientID, DCM_StudyInstanceUID, DCM_NumberOfStudyRelatedInstances});
  for (const nlohmann::json& one : page) {
    DcmDataset data;
    putAnswer(one, keys, data);
    const Answer answer(data, "");
    (void)answer.text(DCM_PatientName);
    (void)answer.count(DCM_NumberOfStudyRelatedInstances);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  if (size < 2) return 0;
  const std::string_view text(reinterpret_cast<const char*>(bytes), size);
  text.front() % 3 ? readParts(text) : readPage(text.substr(1));
  return 0;
}
