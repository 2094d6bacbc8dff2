#pragma once

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcuid.h>

#include <string>
#include <vector>

namespace volumen {

/// Transfer syntaxes in which instances are stored, by preference. In a list of several, archives choose an
/// uncompressed one and convert what they hold; so a requestor offers each alone.
inline const std::vector<std::string> storedSyntaxes{UID_JPEGLSLosslessTransferSyntax,
                                                     UID_JPEGLSLossyTransferSyntax,
                                                     UID_JPEG2000LosslessOnlyTransferSyntax,
                                                     UID_JPEG2000TransferSyntax,
                                                     UID_JPEGProcess14SV1TransferSyntax,
                                                     UID_JPEGProcess14TransferSyntax,
                                                     UID_JPEGProcess1TransferSyntax,
                                                     UID_JPEGProcess2_4TransferSyntax,
                                                     UID_JPEGProcess6_8TransferSyntax,
                                                     UID_JPEGProcess10_12TransferSyntax,
                                                     UID_RLELosslessTransferSyntax,
                                                     UID_DeflatedExplicitVRLittleEndianTransferSyntax,
                                                     UID_MPEG2MainProfileAtMainLevelTransferSyntax,
                                                     UID_MPEG2MainProfileAtHighLevelTransferSyntax,
                                                     UID_MPEG4HighProfileLevel4_1TransferSyntax,
                                                     UID_LittleEndianExplicitTransferSyntax,
                                                     UID_BigEndianExplicitTransferSyntax,
                                                     UID_LittleEndianImplicitTransferSyntax};

}  // namespace volumen
