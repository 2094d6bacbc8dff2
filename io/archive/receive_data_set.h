#pragma once

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmnet/dimse.h>

#include <string>

namespace volumen {

/// Receives a command (PS3.7 6.3) and the presentation context in which it comes.
OFCondition receiveCommand(T_ASC_Association* association, T_ASC_PresentationContextID& context,
                           T_DIMSE_Message& message);

/// Receives the data set of a C-STORE request into a file, after file meta information (PS3.10 7.1), with the
/// bytes that the peer sends. Sets `isWritten` to whether all of them are in the file; a full disk is no
/// error of the association. The condition says whether the association can go on.
OFCondition receiveDataSet(T_ASC_Association* association, T_ASC_PresentationContextID context,
                           const T_DIMSE_C_StoreRQ& request, const std::string& path, bool& isWritten);

/// Answers a C-STORE request with a status.
OFCondition answerStorage(T_ASC_Association* association, T_ASC_PresentationContextID context,
                          const T_DIMSE_C_StoreRQ& request, unsigned status);

/// Receives a data set, if the command has one, and drops it.
OFCondition skipDataSet(T_ASC_Association* association, T_DIMSE_DataSetType type);

}  // namespace volumen
