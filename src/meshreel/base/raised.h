/// Results of a decoder built alone (wasm/): an error goes straight to the host, which gives the decoder up.
// SPDX-License-Identifier: MIT
//
// Half of a small decoder would be code that passes errors on. Here raise() never comes back, the compiler knows, and drops
// all of it. The host has the code, the byte, the innermost field and the sentence; what callers would add is lost.
#pragma once

namespace meshreel {

/// Tells the host, who throws what it throws. byte: where, -1: nowhere.
[[noreturn, gnu::noinline, gnu::cold]] void raise(ErrorCode code, std::string_view message, std::string_view field,
                                                  std::int64_t byte);

/// Never happens.
struct Failure {
    constexpr bool happened() const { return false; }
    operator Error() const { __builtin_unreachable(); }
};

[[noreturn]] inline Failure bad_input(std::string_view message, std::string_view field = {},
                                      std::optional<Place> place = {})
{
    raise(ErrorCode::bad_input, message, field, place ? static_cast<std::int64_t>(place->number) : -1);
}
[[noreturn]] inline Failure unsupported(std::string_view message, std::string_view field = {})
{
    raise(ErrorCode::unsupported, message, field, -1);
}

/// Always a T.
template <class T>
class [[nodiscard]] Result {
public:
    using Value = T;

    Result(T value) : value_(std::move(value)) {}
    Result(Failure) : value_(never()) {}
    Result(const Error& error) : value_(raised(error)) {}

    constexpr bool ok() const { return true; }
    constexpr explicit operator bool() const { return true; }

    T& operator*() & { return value_; }
    const T& operator*() const& { return value_; }
    T&& operator*() && { return std::move(value_); }
    T* operator->() { return &value_; }
    const T* operator->() const { return &value_; }

    const Error& error() const& { __builtin_unreachable(); }
    Error&& error() && { __builtin_unreachable(); }
    Failure failure() && { __builtin_unreachable(); }

private:
    [[noreturn]] static T never() { __builtin_unreachable(); }
    [[noreturn]] static T raised(const Error& error)
    {
        raise(error.code, error.message, error.field,
              error.place ? static_cast<std::int64_t>(error.place->number) : -1);
    }

    T value_;
};

} // namespace meshreel
