/// Result<T>: a value, or an error that says what is wrong, in which file, at which byte or line, in which field.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace meshreel {

/// Why something failed. The values are the exit codes of the command.
enum class ErrorCode : std::uint8_t {
    usage = 1,       ///< the caller asked for something that makes no sense
    io = 2,          ///< a file could not be opened, read or written
    bad_input = 3,   ///< bytes from outside are wrong, broken, or ask for more than the limits allow
    runtime = 4,     ///< anything else
    unsupported = 5, ///< well-formed, but a feature we do not have
    missed = 7,      ///< a promised quality cannot be met
};

/// Where in a file or stream an error was found.
struct Place {
    enum class Unit : std::uint8_t { byte, line } unit = Unit::byte;
    std::uint64_t number = 0; ///< byte offset from 0, or line number from 1
};

/// What went wrong, in words.
#ifndef MESHREEL_DECODER_ALONE
using Sentence = std::string;
#else // a literal
using Sentence = std::string_view;
#endif

/// One failure, told once.
struct Error {
    ErrorCode code = ErrorCode::runtime;
    Sentence message;       ///< a sentence without the place: "17 vertices, but frame 0 has 12"
    std::string field = {}; ///< the field or element concerned: "vertex_count", "f"; may be empty
    std::string file = {};  ///< the file's name, as the user gave it; may be empty
    std::optional<Place> place = {};

    /// "walk.obj: line 12: f: index 9 is beyond the 8 vertices".
    std::string sentence() const;
};

struct Ok {};

} // namespace meshreel

#ifdef MESHREEL_DECODER_ALONE
#include "meshreel/base/raised.h"
#else
namespace meshreel {

/// An Error in a box: a Result is small, and what goes wrong costs no code where it is passed on.
class Failure {
public:
    Failure() = default; ///< none
    Failure(Error error);
    static Failure out_of_memory() noexcept; ///< needs none itself
    Failure(const Failure& other);
    Failure(Failure&& other) noexcept : error_(std::exchange(other.error_, nullptr)) {}
    Failure& operator=(Failure other) noexcept
    {
        std::swap(error_, other.error_);
        return *this;
    }
    ~Failure()
    {
        if (error_ != nullptr) discard();
    }

    bool happened() const { return error_ != nullptr; }
    const Error& operator*() const { return *error_; }
    operator Error() const& { return *error_; }
    operator Error() &&;

private:
    void discard();

    Error* error_ = nullptr;
};

/// Either a T or an Error; test before use.
template <class T>
class [[nodiscard]] Result {
public:
    using Value = T;

    Result(T value) : value_(std::move(value)) {}
    Result(Failure failure) : failure_(std::move(failure)) {}
    Result(Error error) : failure_(std::move(error)) {}

    bool ok() const { return value_.has_value(); }
    explicit operator bool() const { return ok(); }

    T& operator*() & { return *value_; }
    const T& operator*() const& { return *value_; }
    T&& operator*() && { return *std::move(value_); }
    T* operator->() { return &*value_; }
    const T* operator->() const { return &*value_; }

    const Error& error() const& { return *failure_; }
    Error error() && { return std::move(failure_); }
    Failure&& failure() && { return std::move(failure_); }

private:
    std::optional<T> value_; ///< none: an error
    Failure failure_;
};

Failure bad_input(std::string_view message, std::string_view field = {}, std::optional<Place> place = {});
Failure unsupported(std::string_view message, std::string_view field = {});

} // namespace meshreel
#endif

namespace meshreel {

using Status = Result<Ok>;

/// The same result, its error naming `file` where none is named yet.
template <class T>
Result<T> in_file(Result<T> result, const std::string& file)
{
    if (result.ok() || !result.error().file.empty()) return result;
    Error error = std::move(result).error();
    error.file = file;
    return error;
}

inline Place at_byte(std::uint64_t offset)
{
    return {Place::Unit::byte, offset};
}
inline Place at_line(std::uint64_t line)
{
    return {Place::Unit::line, line};
}

} // namespace meshreel

#define MESHREEL_JOIN_(a, b) a##b
#define MESHREEL_JOIN(a, b) MESHREEL_JOIN_(a, b)

/// MESHREEL_TRY(auto mesh, read_mesh(bytes)): declares mesh, or returns the error from the enclosing function.
#define MESHREEL_TRY(declaration, expression)                                                                          \
    auto MESHREEL_JOIN(result_, __LINE__) = (expression);                                                              \
    if (!MESHREEL_JOIN(result_, __LINE__).ok()) return std::move(MESHREEL_JOIN(result_, __LINE__)).failure();          \
    declaration = *std::move(MESHREEL_JOIN(result_, __LINE__))

/// MESHREEL_CHECK(status): goes on, or returns the error from the enclosing function.
#define MESHREEL_CHECK(expression)                                                                                     \
    do {                                                                                                               \
        auto meshreel_status = (expression);                                                                           \
        if (!meshreel_status.ok()) return std::move(meshreel_status).failure();                                        \
    } while (false)
