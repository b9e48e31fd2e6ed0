/// PCA, basis, residuals; and back.
// SPDX-License-Identifier: MIT
#include "meshreel/codecs/pca_codec.h"

#include <algorithm>
#include <cmath>

#include "meshreel/codecs/choice.h"
#include "meshreel/codecs/components.h"
#include "meshreel/codecs/entropy.h"
#include "meshreel/container/explain.h"

namespace meshreel::codecs {

namespace {

coding::Contexts basis_contexts(Entropy entropy)
{
    return {grid_of(entropy).size(basis_context_rows), {predict::motion_orders}};
}

Bytes raw_basis(Basis& basis)
{
    Bytes bytes;
    for (std::span<double> values : {std::span<double>(basis.mean), std::span<double>(basis.rows.values)})
        for (double& value : values) {
            value = static_cast<float>(value);
            bytes.resize(bytes.size() + 4);
            container::store_real(static_cast<float>(value), bytes.data() + bytes.size() - 4);
        }
    return bytes;
}

/// Writes the basis; afterwards it is what the decoder will see.
Bytes write_basis(const BasisLaw& law, Entropy entropy, Basis& basis)
{
    if (law.coding == BasisCoding::raw) return raw_basis(basis);
    return written(entropy, basis_contexts(entropy),
                   [&](auto& coder) { code_basis(coder, law, grid_of(entropy), basis); });
}

Status read_raw_basis(ByteView bytes, Basis& basis)
{
    const std::size_t values = basis.mean.size() + basis.rows.values.size();
    if (bytes.size() != 4 * values) return bad_input("does not hold a float32 for each value");
    const auto value = [&](std::size_t i) { return container::load_real<float>(bytes.data() + 4 * i); };
    for (std::size_t i = 0; i < basis.mean.size(); ++i) basis.mean[i] = value(i);
    for (std::size_t i = 0; i < basis.rows.values.size(); ++i) basis.rows.values[i] = value(basis.mean.size() + i);
    return Ok{};
}

Status read_basis(const PcaPayload& payload, Basis& basis)
{
    if (payload.law.coding == BasisCoding::raw) return read_raw_basis(payload.basis_bits, basis);
    return taken(payload.entropy, payload.basis_bits, basis_contexts(payload.entropy),
                 [&](auto& coder) { code_basis(coder, payload.law, grid_of(payload.entropy), basis); });
}

class PcaEncoder : public ComponentEncoder {
public:
    PcaEncoder(const Sequence& sequence, std::size_t max_bases, Threads threads, StudyResiduals study)
        : ComponentEncoder(sequence, max_bases, threads)
    {
        const Matrix<double> C = linalg::project(sequence.frames, pca_.mean, pca_.basis.view(), threads).C;
        mean_absolute_ = linalg::mean_absolute(C.view());
        Matrix<float> rounded(C.rows, C.cols);
        std::copy(C.values.begin(), C.values.end(), rounded.values.begin());
        residuals_ = study(sequence_, rounded.view());
    }

    Trial encode(const Settings& settings) const override
    {
        CodedBasis coded = code_basis(settings);
        Bytes residual_bits;
        return trial_of(std::move(coded.basis), settings, [&](const Basis&, MatrixView<double> C) {
            residual_bits = residuals_->write(coded.payload, C);
            coded.payload.basis_bits = coded.bits;
            coded.payload.residual_bits = residual_bits;
            return coded.payload;
        });
    }

private:
    /// A basis as the decoder will see it, its bits, and the payload's head that says how.
    struct CodedBasis {
        PcaPayload payload;
        Basis basis;
        Bytes bits;
    };

    CodedBasis code_basis(const Settings& settings) const
    {
        const std::size_t K = bases_of(settings, pca_.singular_values, sequence_.surface.vertex_count),
                          n = pca_.mean.size();
        const double W = sequence_.surface.vertex_count;
        CodedBasis coded;
        coded.payload.bases = static_cast<std::uint32_t>(K);
        coded.payload.step = step_of(settings, pca_.singular_values, sequence_.surface.vertex_count);
        coded.payload.entropy = settings.entropy;
        coded.payload.law = basis_law(settings.basis, settings.basis_ratio * coded.payload.step / std::sqrt(W),
                                      std::span(mean_absolute_).first(K));
        coded.basis = {pca_.mean, Matrix<double>(K, n)};
        std::copy_n(pca_.basis.values.begin(), K * n, coded.basis.rows.values.begin());
        coded.bits = write_basis(coded.payload.law, settings.entropy, coded.basis);
        return coded;
    }

    std::vector<double> mean_absolute_; ///< a_i (8.24), [all components]
    std::unique_ptr<ResidualWriter> residuals_;
};

} // namespace

std::unique_ptr<Encoder> prepare_pca(const Sequence& sequence, std::size_t max_bases, Threads threads,
                                     StudyResiduals study)
{
    return std::make_unique<PcaEncoder>(sequence, max_bases, threads, study);
}

Result<Trajectories> open_pca(const Coded& coded, ReadResiduals read)
{
    const container::Source& source = coded.payload;
    MESHREEL_TRY(const PcaPayload payload, container::read_fields<PcaPayload>(source, coded.limits));
    MESHREEL_CHECK(check_bases(coded, payload.bases));
    const std::size_t K = payload.bases, n = 3 * coded.frame_count, W = coded.surface.vertex_count;
    Trajectories result{{std::vector<double>(n), Matrix<double>(K, n)}, Matrix<double>(W, K)};
    MESHREEL_CHECK(at_part(read_basis(payload, result.basis), source, payload.basis_bits, "basis_bits"));
    MESHREEL_CHECK(at_part(read(payload, coded, result.C.view()), source, payload.residual_bits, "residual_bits"));
    return result;
}

Status explain_pca(const container::Source& source, const DecodeLimits& limits, std::string& lines)
{
    return container::explain_fields<PcaPayload>(source, limits, lines);
}

} // namespace meshreel::codecs
