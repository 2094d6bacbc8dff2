// Sending over one association (PS3.4 B, PS3.7 9.1.1).
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcfilefo.h>
#include <dcmtk/dcmdata/dcuid.h>

#include <cstring>
#include <limits>

#include "io/archive/association_private.h"
#include "io/dicom/decode.h"

namespace volumen {

namespace {

// Returns what a status of C-STORE means (PS3.4 B.2.3, PS3.7 C), as the end of a sentence; empty if it is
// stored, with a warning or without.
std::string storageRefusal(unsigned status) {
  constexpr unsigned duplicate = 0x0111;
  if (status == 0 || (status >= 0xb000 && status <= 0xbfff)) return "";
  if (status == duplicate) return "has an image of this UID already, which may differ (status 0111)";
  if ((status & 0xff00) == 0xa700)
    return "says that it is out of resources (status " + statusText(status) + ")";
  if ((status & 0xff00) == 0xa900)
    return "finds that it contradicts its class (status " + statusText(status) + ")";
  if ((status & 0xf000) == 0xc000) return "does not understand it (status " + statusText(status) + ")";
  return "refuses it with status " + statusText(status);
}

// Returns the name of a UID, or the UID.
std::string nameOf(const std::string& uid) {
  const char* const name = dcmFindNameOfUID(uid.c_str());
  return name ? name : uid;
}

// Returns the context for a class in a transfer syntax, 0 if there is none. DCMTK's own search falls back on
// contexts in others.
T_ASC_PresentationContextID acceptedContext(T_ASC_Association* association, const std::string& sopClass,
                                            const char* syntax) {
  for (int n = 0; n < ASC_countPresentationContexts(association->params); ++n) {
    T_ASC_PresentationContext context;
    if (ASC_getPresentationContext(association->params, n, &context).good() &&
        context.resultReason == ASC_P_ACCEPTANCE && sopClass == context.abstractSyntax &&
        std::strcmp(syntax, context.acceptedTransferSyntax) == 0)
      return context.presentationContextID;
  }
  return 0;
}

const char* const plainSyntaxes[] = {UID_LittleEndianExplicitTransferSyntax,
                                     UID_LittleEndianImplicitTransferSyntax,
                                     UID_BigEndianExplicitTransferSyntax};

}  // namespace

Result<std::string> Association::store(const dicom::InstanceUids& uids, const std::string& path) {
  T_ASC_Association* const association = p_->association;
  const auto contextIn = [&](const char* syntax) {
    return acceptedContext(association, uids.sopClass, syntax);
  };
  DcmFileFormat file;
  if (file.loadFile(path.c_str()).bad()) return std::string("it cannot be read");
  DcmDataset* const data = file.getDataset();
  if (!uids.transferSyntax.empty() && DcmXfer(uids.transferSyntax.c_str()).getXfer() == EXS_Unknown)
    return std::string("volumen sends no ") + nameOf(uids.transferSyntax) + " by DIMSE, but by DICOMweb";
  T_ASC_PresentationContextID context = contextIn(uids.transferSyntax.c_str());
  for (const char* plain : plainSyntaxes)
    if (context == 0) {
      // Decompressed pixels are the same; the archive takes no others.
      dicom::registerDecoders();
      context = contextIn(plain);
      const E_TransferSyntax syntax = DcmXfer(plain).getXfer();
      if (context != 0 && (data->chooseRepresentation(syntax, nullptr).bad() || !data->canWriteXfer(syntax)))
        context = 0;
    }
  if (context == 0)
    return p_->says("takes no " + nameOf(uids.transferSyntax) + " of class " + nameOf(uids.sopClass)).message;
  T_DIMSE_C_StoreRQ request{};
  request.MessageID = association->nextMsgID++;
  std::strncpy(request.AffectedSOPClassUID, uids.sopClass.c_str(), sizeof request.AffectedSOPClassUID - 1);
  std::strncpy(request.AffectedSOPInstanceUID, uids.instance.c_str(),
               sizeof request.AffectedSOPInstanceUID - 1);
  request.DataSetType = DIMSE_DATASET_PRESENT;
  request.Priority = DIMSE_PRIORITY_MEDIUM;
  p_->watch.allow(mostBytesOfCommand, std::chrono::hours(24));
  T_DIMSE_C_StoreRSP response{};
  DcmDataset* detail = nullptr;
  const OFCondition done = DIMSE_storeUser(association, context, &request, nullptr, data, nullptr, nullptr,
                                           DIMSE_BLOCKING, 0, &response, &detail);
  delete detail;
  if (done.bad()) return p_->failure(done);
  const std::string answered =
      response.opts & O_STORE_AFFECTEDSOPINSTANCEUID ? response.AffectedSOPInstanceUID : "";
  if (!answered.empty() && answered != uids.instance) return p_->says("answers for another image").message;
  const std::string refusal = storageRefusal(response.DimseStatus);
  return refusal.empty() ? refusal : p_->says(refusal).message;
}

}  // namespace volumen
