// Fuzzes sessions. A valid session must be readable after it was written.
#include <cstdlib>

#include "ui/workspace/session_json.h"

using namespace volumen;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(bytes), size);
  const FindSeries isThere = [](const SavedSeries& saved) {
    return std::make_shared<const Series>(saved.series);
  };
  const Result<SavedSession> session = sessionFromJson(text, isThere);
  if (!session) return 0;
  const Result<std::string> written = sessionToJson(session->workspace, "/", session->savedAs);
  if (!written || !sessionFromJson(*written, isThere)) std::abort();
  return 0;
}
