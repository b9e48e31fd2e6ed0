/// What all codecs over PCA coefficients share: payload, basis, choice of K and step, encoder. Each adds its residuals.
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "meshreel/codecs/basis.h"
#include "meshreel/codecs/codec.h"
#include "meshreel/container/fields.h"

namespace meshreel::codecs {

/// The payload: what stands before the bits, and the bits.
struct PcaPayload {
    std::uint32_t bases = 0;
    double step = 1.0;
    Entropy entropy = Entropy::range;
    BasisLaw law;
    ByteView basis_bits, residual_bits;

    void fields(auto& io)
    {
        io.varint("bases", bases, {0, 3'000'000}, "K, the number of eigentrajectories");
        io.f64("step", step, container::positive, "D, quantisation step of the coefficients, model units");
        io.choice("entropy", entropy, {"huffman", "range"}, "coder of all residuals");
        io.choice("basis_coding", law.coding, basis_coding_names, "how mean and basis are coded");
        io.when(law.coding != BasisCoding::raw, "basis_coding is not raw", [&] {
            io.f64("mean_step", law.mean_step, container::positive, "Q_m (8.29), model units");
            io.f64("k", law.k, container::not_negative, "scale of the steps, Q_i = k i^q + a (8.26)");
            io.f64("q", law.q, {0.0, 16.0}, "exponent, used to 2^-16");
            io.f64("a", law.a, container::finite, "shift (8.28)");
            io.must(law.k + law.a > 0, "a", "the first step k + a is above 0");
        });
        io.blob("basis_bits", basis_bits, container::any, "mean and basis, see codecs/coddyac.md");
        io.blob("residual_bits", residual_bits, container::any, "residuals of the coefficients, see the codec's page");
    }
};

/// The encoder's side of a codec's residuals, prepared once for a sequence.
class ResidualWriter {
public:
    virtual ~ResidualWriter() = default;
    /// The residual bits; afterwards C [W x K], model units, holds what the decoder will see, bit for bit.
    virtual Bytes write(const PcaPayload& head, MatrixView<double> C) const = 0;
};

/// Prepares a codec's residuals: all that does not depend on step and K. C: [W x all components] in the exact basis.
using StudyResiduals = std::unique_ptr<ResidualWriter> (*)(const Sequence& sequence, MatrixView<const float> C);

/// Fills C [W x K] from head.residual_bits. @fails bad_input; field and place are set by the caller.
using ReadResiduals = Status (*)(const PcaPayload& head, const Coded& coded, MatrixView<double> C);

std::unique_ptr<Encoder> prepare_pca(const Sequence& sequence, std::size_t max_bases, Threads threads,
                                     StudyResiduals study);
Result<Trajectories> open_pca(const Coded& coded, ReadResiduals read);
Status explain_pca(const container::Source& source, const DecodeLimits& limits, std::string& lines);

/// A row of the registry, from a codec's residuals.
template <StudyResiduals study, ReadResiduals read>
Codec pca_codec(std::string_view name, std::string_view summary)
{
    const auto prepare = [](const Sequence& sequence, std::size_t max_bases, Threads threads) {
        return prepare_pca(sequence, max_bases, threads, study);
    };
    return {name, summary, encoder_side(+prepare), [](const Coded& coded) { return open_pca(coded, read); },
            encoder_side(explain_pca)};
}

} // namespace meshreel::codecs
