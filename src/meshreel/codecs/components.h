/// What every codec over principal components shares: how they are prepared, how a trial ends, what a reader checks.
// SPDX-License-Identifier: MIT
#pragma once

#include <cassert>

#include "meshreel/codecs/codec.h"
#include "meshreel/linalg/pca.h"

namespace meshreel::codecs {

/// An encoder over the principal components of trajectories.
class ComponentEncoder : public Encoder {
public:
    ComponentEncoder(const Sequence& sequence, std::size_t max_bases, Threads threads)
        : sequence_(sequence), pca_(linalg::pca_of_trajectories(sequence.frames, max_bases, threads))
    {
    }

    double energy() const override { return pca_.energy; }

    std::span<const double> singular_values() const override { return pca_.singular_values; }

protected:
    /// The trial that a payload makes. basis: as the decoder will see it. code(basis, C): returns the payload, a struct
    /// with fields, `bases` and `step`; given the coefficients C [W x K] in that basis, it leaves what the decoder will see.
    template <class Code>
    Trial trial_of(Basis basis, const Settings& settings, const Code& code) const
    {
        linalg::Projection projection =
            linalg::project(sequence_.frames, basis.mean, basis.rows.view(), settings.threads);
        const Matrix<double> wanted = projection.C;
        for (const Nudge& nudge : settings.nudges) apply(nudge, basis, projection.C.row(nudge.vertex));
        const auto payload = code(basis, projection.C.view());
        Result<Bytes> bytes = container::write_fields(payload);
        assert(bytes.ok());
        const double error =
            projection.squared_error + linalg::squared_distance(wanted.view(), projection.C.view(), basis.rows.view());
        return {*std::move(bytes), payload.bases, payload.step, error, {std::move(basis), std::move(projection.C)}};
    }

    Sequence sequence_;
    linalg::Pca pca_;

private:
    /// Not to the first components: in reel all vertices hang on those.
    static void apply(const Nudge& nudge, const Basis& basis, std::span<double> c)
    {
        const std::size_t F = basis.mean.size() / 3;
        for (std::size_t k = 3; k < c.size(); ++k)
            for (std::size_t axis = 0; axis < 3; ++axis)
                c[k] += basis.rows(k, axis * F + nudge.frame) * nudge.shift[axis];
    }
};

/// Refuses K components that there cannot be, that do not fit in memory, or mean too much work. @fails bad_input at `bases`.
Status check_bases(const Coded& coded, std::uint64_t K);

/// An error of a part of a payload, said at the place of that part.
Status at_part(Status status, const container::Source& source, ByteView part, std::string_view field);

} // namespace meshreel::codecs
