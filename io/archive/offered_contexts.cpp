#include "io/archive/offered_contexts.h"

#include <dcmtk/dcmdata/dcuid.h>
#include <dcmtk/dcmdata/dcxfer.h>

#include <algorithm>
#include <span>

#include "io/archive/stored_syntaxes.h"

namespace volumen {

namespace {

// Returns the preferred one of these transfer syntaxes; empty if none can be received. DCMTK receives those
// that it knows. Data sets that refer to pixels elsewhere (JPIP) would be incomplete.
std::string preferred(std::span<const DIC_UI> proposed) {
  for (const std::string& syntax : storedSyntaxes)
    if (std::ranges::any_of(proposed, [&](const char* one) { return syntax == one; })) return syntax;
  for (const char* one : proposed)
    if (const DcmXfer syntax(one); syntax.getXfer() != EXS_Unknown && !syntax.isReferenced()) return one;
  return "";
}

}  // namespace

bool isStorageClass(const std::string& sopClass) {
  const bool isStandard = sopClass.starts_with("1.2.840.10008.");
  return !isStandard || sopClass.starts_with("1.2.840.10008.5.1.4.1.1.") ||
         dcmIsaStorageSOPClassUID(sopClass.c_str(), ESSC_All);
}

void acceptContexts(T_ASC_Parameters& parameters) {
  const int count = ASC_countPresentationContexts(&parameters);
  for (int n = 0; n < count; ++n) {
    T_ASC_PresentationContext context;
    // Of more than 50 transfer syntaxes it returns the first 50, and an error.
    ASC_getPresentationContext(&parameters, n, &context);
    const std::string sopClass = context.abstractSyntax;
    const std::string syntax = preferred(context.proposedTransferSyntaxes);
    if (sopClass != UID_VerificationSOPClass && !isStorageClass(sopClass))
      ASC_refusePresentationContext(&parameters, context.presentationContextID,
                                    ASC_P_ABSTRACTSYNTAXNOTSUPPORTED);
    else if (syntax.empty())
      ASC_refusePresentationContext(&parameters, context.presentationContextID,
                                    ASC_P_TRANSFERSYNTAXESNOTSUPPORTED);
    else
      ASC_acceptPresentationContext(&parameters, context.presentationContextID, syntax.c_str());
  }
}

}  // namespace volumen
