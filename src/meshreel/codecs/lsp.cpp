/// Least squares prediction: the predictor that refines the decimated mesh.
// SPDX-License-Identifier: MIT
#include "meshreel/codecs/lsp.h"

#include "meshreel/codecs/decimated.h"
#include "meshreel/predict/lsp.h"

namespace meshreel::codecs {

Codec lsp()
{
    return pca_codec<study_decimated<predict::Lsp, RemovalOrder::accuracy>, read_decimated<predict::Lsp>>(
        "lsp", "coarse mesh by Coddyac, the rest by least squares of its neighbours (thesis 8.3.1)");
}

} // namespace meshreel::codecs
