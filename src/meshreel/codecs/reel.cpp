/// reel's two directions: basis as poses, first components along the surface, the others from coarse to fine.
// SPDX-License-Identifier: MIT
#include "meshreel/codecs/reel.h"

#include <algorithm>
#include <cmath>

#include "meshreel/codecs/choice.h"
#include "meshreel/codecs/components.h"
#include "meshreel/codecs/entropy.h"
#include "meshreel/codecs/level_walk.h"
#include "meshreel/codecs/pose_walk.h"
#include "meshreel/codecs/surface_walk.h"
#include "meshreel/container/explain.h"

namespace meshreel::codecs {

namespace {

struct ReelPayload {
    std::uint32_t bases = 0;
    double step = 1.0, first_step = 1.0, basis_step = 1.0;
    std::array<double, 3> origin{};
    InterpolationLaw law;
    ByteView basis_bits, first_bits, level_bits;

    void fields(auto& io)
    {
        io.varint("bases", bases, {0, 3'000'000}, "K, the number of eigentrajectories");
        io.f64("step", step, container::positive, "D, quantisation step of the coefficients, model units");
        io.f64("first_step", first_step, container::positive, "the step of coefficients 0, 1, 2");
        io.f64("basis_step", basis_step, container::positive, "step of the poses, scaled by what they weigh");
        io.f64("origin_x", origin[0], container::finite, "added to the mean's x in every frame");
        io.f64("origin_y", origin[1], container::finite, "likewise y");
        io.f64("origin_z", origin[2], container::finite, "likewise z");
        io.f64("linear", law.linear, {0.0, 1e6}, "trust in motions known already against smoothness");
        io.f64("squared_bend", law.squared_bend, {1e-6, 1e6}, "c^2 of the multiquadric");
        io.varint("growth", law.growth, {1, 1'000'000}, "batches grow by so many eighths of the components known");
        io.blob("basis_bits", basis_bits, container::any, "poses, see codecs/reel.md");
        io.blob("first_bits", first_bits, container::any, "coefficients 0, 1, 2, see codecs/reel.md");
        io.blob("level_bits", level_bits, container::any, "the other coefficients, see codecs/reel.md");
    }
};

constexpr std::size_t first_components = SurfaceWalk<coding::RangeEncoder>::most;

/// Basis and mean as poses, [F x 3(K+1)]: the mean's weight is sqrt(W), an eigentrajectory's its singular value.
Matrix<double> poses_of(const linalg::Pca& pca, std::size_t K, const ReelPayload& head, double W)
{
    const std::size_t F = pca.mean.size() / 3;
    Matrix<double> Y(F, 3 * (K + 1));
    for (std::size_t f = 0; f < F; ++f)
        for (std::size_t c = 0; c < 3; ++c) {
            Y(f, c) = std::sqrt(W) * (pca.mean[c * F + f] - head.origin[c]);
            for (std::size_t k = 0; k < K; ++k)
                Y(f, 3 * (k + 1) + c) = pca.singular_values[k] * pca.basis(k, c * F + f);
        }
    return Y;
}

/// A basis of unit vectors, and the energies that its poses had.
struct WeighedBasis {
    Basis basis;
    std::vector<double> energies; ///< [K]
};

/// What decoder and encoder make of coded poses.
WeighedBasis basis_of(MatrixView<const double> Y, const ReelPayload& head, double W)
{
    const std::size_t F = Y.rows, K = Y.cols / 3 - 1;
    WeighedBasis result{{std::vector<double>(3 * F), Matrix<double>(K, 3 * F)}, std::vector<double>(K, 0.0)};
    const double unit = 1.0 / std::sqrt(W);
    for (std::size_t k = 0; k < K; ++k)
        for (std::size_t f = 0; f < F; ++f)
            for (std::size_t c = 0; c < 3; ++c) result.energies[k] += Y(f, 3 * (k + 1) + c) * Y(f, 3 * (k + 1) + c);
    for (std::size_t f = 0; f < F; ++f)
        for (std::size_t c = 0; c < 3; ++c) result.basis.mean[c * F + f] = head.origin[c] + unit * Y(f, c);
    for (std::size_t k = 0; k < K; ++k) {
        const double scale = result.energies[k] > 0 ? 1.0 / std::sqrt(result.energies[k]) : 0.0;
        for (std::size_t f = 0; f < F; ++f)
            for (std::size_t c = 0; c < 3; ++c) result.basis.rows(k, c * F + f) = scale * Y(f, 3 * (k + 1) + c);
    }
    return result;
}

/// The components that place the vertices, [W x 3]; C has more.
Matrix<double> first_of(MatrixView<const double> C)
{
    Matrix<double> first(C.rows, first_components);
    for (std::size_t v = 0; v < C.rows; ++v) std::copy_n(C.row(v).data(), first_components, first.row(v).data());
    return first;
}

class ReelEncoder : public ComponentEncoder {
public:
    using ComponentEncoder::ComponentEncoder;

    Trial encode(const Settings& settings) const override
    {
        CodedBasis coded = code_basis(settings);
        CodedCoefficients bits;
        return trial_of(std::move(coded.basis), settings.threads, [&](MatrixView<double> C) {
            bits = code_coefficients(coded, settings, C);
            coded.head.basis_bits = coded.bits;
            coded.head.first_bits = bits.first;
            coded.head.level_bits = bits.levels;
            return coded.head;
        });
    }

private:
    struct CodedBasis {
        ReelPayload head;
        Basis basis;
        std::vector<double> energies;
        Bytes bits;
    };
    struct CodedCoefficients {
        Bytes first, levels;
    };

    /// A basis as the decoder will see it. A component that the step leaves nothing of ends it.
    CodedBasis code_basis(const Settings& settings) const
    {
        const double W = sequence_.surface.vertex_count;
        const std::size_t F = pca_.mean.size() / 3;
        CodedBasis coded;
        coded.head.step = step_of(settings, pca_.singular_values, W);
        coded.head.first_step = settings.first_ratio * coded.head.step;
        coded.head.basis_step = settings.basis_ratio * coded.head.step;
        coded.head.law = {settings.linear, settings.squared_bend, coded.head.step, settings.growth};
        for (std::size_t c = 0; c < 3; ++c) coded.head.origin[c] = static_cast<float>(pca_.mean[c * F]);
        for (std::size_t K = bases_of(settings, pca_.singular_values, W);;) {
            Matrix<double> Y = poses_of(pca_, K, coded.head, W);
            coded.bits = range_written([&](coding::RangeEncoder& core) {
                PoseWalk(core, coding::Quantiser{coded.head.basis_step}).code(Y.view());
            });
            WeighedBasis weighed = basis_of(Y.view(), coded.head, W);
            const auto nothing = std::find(weighed.energies.begin(), weighed.energies.end(), 0.0);
            if (nothing == weighed.energies.end()) {
                coded.head.bases = static_cast<std::uint32_t>(K);
                coded.basis = std::move(weighed.basis);
                coded.energies = std::move(weighed.energies);
                return coded;
            }
            K = static_cast<std::size_t>(nothing - weighed.energies.begin());
        }
    }

    CodedCoefficients code_coefficients(const CodedBasis& coded, const Settings& settings, MatrixView<double> C) const
    {
        const std::size_t first = std::min(C.cols, first_components);
        Matrix<std::uint8_t> L(C.rows, C.cols);
        CodedCoefficients bits;
        bits.first = range_written([&](coding::RangeEncoder& core) {
            SurfaceWalk(core, sequence_.surface, {coded.head.first_step, settings.dead_zone}).code(first, C, L.view());
        });
        if (C.cols == first) return bits;
        const Interpolation interpolation(first_of(C).view(), relevance_of(coded.energies), coded.head.law,
                                          settings.threads);
        bits.levels = range_written([&](coding::RangeEncoder& core) {
            LevelWalk(core, interpolation, {coded.head.step, settings.dead_zone}).code(first, C, L.view());
        });
        return bits;
    }
};

std::unique_ptr<Encoder> prepare_reel(const Sequence& sequence, std::size_t max_bases, Threads threads)
{
    return std::make_unique<ReelEncoder>(sequence, max_bases, threads);
}

Result<Trajectories> open_reel(const Coded& coded)
{
    const container::Source& source = coded.payload;
    MESHREEL_TRY(ReelPayload head, container::read_fields<ReelPayload>(source, coded.limits));
    MESHREEL_CHECK(check_bases(coded, head.bases));
    head.law.step = head.step;
    const std::size_t K = head.bases, W = coded.surface.vertex_count, first = std::min(K, first_components);
    const auto read = [&](ByteView part, const char* field, const auto& body) {
        return at_part(range_taken(part, body), source, part, field);
    };
    Matrix<double> Y(coded.frame_count, 3 * (K + 1));
    MESHREEL_CHECK(read(head.basis_bits, "basis_bits", [&](coding::RangeDecoder& core) {
        PoseWalk(core, coding::Quantiser{head.basis_step}).code(Y.view());
    }));
    WeighedBasis weighed = basis_of(Y.view(), head, static_cast<double>(W));
    Trajectories result{std::move(weighed.basis), Matrix<double>(W, K)};
    Matrix<std::uint8_t> L(W, K);
    MESHREEL_CHECK(read(head.first_bits, "first_bits", [&](coding::RangeDecoder& core) {
        SurfaceWalk(core, coded.surface, coding::Quantiser{head.first_step}).code(first, result.C.view(), L.view());
    }));
    if (K == first) return result;
    const Interpolation interpolation(first_of(result.C.view()).view(), relevance_of(weighed.energies), head.law,
                                      coded.threads);
    MESHREEL_CHECK(read(head.level_bits, "level_bits", [&](coding::RangeDecoder& core) {
        LevelWalk(core, interpolation, coding::Quantiser{head.step}).code(first, result.C.view(), L.view());
    }));
    return result;
}

Status explain_reel(const container::Source& source, const DecodeLimits& limits, std::string& lines)
{
    return container::explain_fields<ReelPayload>(source, limits, lines);
}

} // namespace

Codec reel()
{
    return {"reel", "PCA of trajectories, kriging from coarse to fine over vertices and over poses", prepare_reel,
            open_reel, explain_reel};
}

} // namespace meshreel::codecs
