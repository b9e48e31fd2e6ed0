/// Neighbourhood average: the predictor that refines the decimated mesh.
// SPDX-License-Identifier: MIT
#include "meshreel/codecs/average.h"

#include "meshreel/codecs/decimated.h"
#include "meshreel/predict/average.h"

namespace meshreel::codecs {

Codec average()
{
    return pca_codec<study_decimated<predict::Average, RemovalOrder::accuracy, RemovalOrder::price>,
                     read_decimated<predict::Average>>(
        "na", "coarse mesh by Coddyac, the rest by the average of its neighbours (thesis 8.2)");
}

} // namespace meshreel::codecs
