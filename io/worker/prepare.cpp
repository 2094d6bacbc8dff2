#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcdict.h>

#include <clocale>
#include <ctime>

#include "io/dicom/decode.h"
#include "io/worker/serve.h"

namespace volumen::worker {

void prepareToServe() {
  dcmDataDict.rdlock();
  dcmDataDict.rdunlock();
  dicom::registerDecoders();
  dicom::loadCharacterSets();
  std::setlocale(LC_CTYPE, "C.UTF-8");  // libarchive converts names to it
  tzset();
}

}  // namespace volumen::worker
