/// Coddyac's residuals: the walk along the gates of the surface, in both directions.
// SPDX-License-Identifier: MIT
#include "meshreel/codecs/coddyac.h"

#include "meshreel/codecs/entropy.h"
#include "meshreel/codecs/pca_codec.h"

namespace meshreel::codecs {

namespace {

coding::Contexts coddyac_contexts(Entropy entropy, std::size_t bases)
{
    return {grid_of(entropy).size(static_cast<std::uint32_t>(bases)), {}};
}

/// The walk, for whichever coder.
auto coddyac_walk(const PcaPayload& head, const connectivity::Surface& surface, MatrixView<double> C)
{
    return [&head, &surface, C](auto& coder) {
        Matrix<std::int32_t> levels(C.rows + 1, C.cols);
        ResidualWalk(coder, grid_of(head.entropy), {head.step}, levels.view()).code(surface.gates, C);
    };
}

class CoddyacWriter : public ResidualWriter {
public:
    explicit CoddyacWriter(const connectivity::Surface& surface) : surface_(surface) {}

    Bytes write(const PcaPayload& head, MatrixView<double> C) const override
    {
        return written(head.entropy, coddyac_contexts(head.entropy, C.cols), coddyac_walk(head, surface_, C));
    }

private:
    const connectivity::Surface& surface_;
};

std::unique_ptr<ResidualWriter> study_coddyac(const Sequence& sequence, MatrixView<const float>)
{
    return std::make_unique<CoddyacWriter>(sequence.surface);
}

Status read_coddyac(const PcaPayload& head, const Coded& coded, MatrixView<double> C)
{
    return taken(head.entropy, head.residual_bits, coddyac_contexts(head.entropy, C.cols),
                 coddyac_walk(head, coded.surface, C));
}

} // namespace

Codec coddyac()
{
    return pca_codec<study_coddyac, read_coddyac>("coddyac",
                                                  "PCA of trajectories, parallelogram along Edgebreaker, Cobra basis");
}

} // namespace meshreel::codecs
