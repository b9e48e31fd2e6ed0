/// RBF based prediction: the predictor that refines the decimated mesh.
// SPDX-License-Identifier: MIT
#include "meshreel/codecs/rbfp.h"

#include "meshreel/codecs/decimated.h"
#include "meshreel/predict/rbf.h"

namespace meshreel::codecs {

Codec rbfp()
{
    return pca_codec<study_decimated<predict::Rbf, RemovalOrder::accuracy>, read_decimated<predict::Rbf>>(
        "rbfp", "coarse mesh by Coddyac, the rest by radial basis functions (thesis 8.3.2)");
}

} // namespace meshreel::codecs
