#pragma once

#include <cstddef>
#include <cstdint>

/// Four doubles or eight floats at a time, for the kernel of BranchAndBound alone: with AVX2 one
/// register, else halves of the 16 bytes that every x86-64 processor has (and, written with the
/// compiler's vectors, others too). The same operations give the same bits both ways.
///
/// Everything is inlined and in an unnamed namespace: the two translation units that include this
/// must not share a function.
namespace hlc::branch_and_bound {
namespace {

#define HLC_INLINE [[gnu::always_inline]] inline

#ifdef __AVX2__
using Doubles = double __attribute__((vector_size(32)));
using Floats = float __attribute__((vector_size(32)));
using DoubleBits = long long __attribute__((vector_size(32)));
using FloatBits = int __attribute__((vector_size(32)));
/// The same in memory, at any address of an element.
using DoublesInMemory = double __attribute__((vector_size(32), aligned(8), may_alias));
using FloatsInMemory = float __attribute__((vector_size(32), aligned(4), may_alias));
using HalfFloatsInMemory = float __attribute__((vector_size(16), aligned(4), may_alias));

HLC_INLINE Doubles load(const double* from) {
  return *reinterpret_cast<const DoublesInMemory*>(from);
}
HLC_INLINE Floats load(const float* from) { return *reinterpret_cast<const FloatsInMemory*>(from); }
HLC_INLINE void store(double* to, const Doubles& value) {
  *reinterpret_cast<DoublesInMemory*>(to) = value;
}
HLC_INLINE void store(float* to, const Floats& value) {
  *reinterpret_cast<FloatsInMemory*>(to) = value;
}
/// Rounded to four floats.
HLC_INLINE void store(float* to, const Doubles& value) {
  *reinterpret_cast<HalfFloatsInMemory*>(to) =
      __builtin_convertvector(value, float __attribute__((vector_size(16))));
}
HLC_INLINE Doubles all(double value) { return Doubles{value, value, value, value}; }
HLC_INLINE Floats all(float value) {
  return Floats{value, value, value, value, value, value, value, value};
}
template <class V>
HLC_INLINE V smaller(const V& a, const V& b) {
  return a < b ? a : b;
}
template <class V>
HLC_INLINE V larger(const V& a, const V& b) {
  return a > b ? a : b;
}
/// Per element: a < b ? then : otherwise.
template <class V>
HLC_INLINE V if_less(const V& a, const V& b, const V& then, const V& otherwise) {
  return a < b ? then : otherwise;
}
HLC_INLINE Doubles absolute(const Doubles& a) {
  constexpr long long kNoSign = 0x7fff'ffff'ffff'ffff;
  return reinterpret_cast<Doubles>(reinterpret_cast<DoubleBits>(a) &
                                   DoubleBits{kNoSign, kNoSign, kNoSign, kNoSign});
}
HLC_INLINE Floats absolute(const Floats& a) {
  constexpr int kNoSign = 0x7fff'ffff;
  return reinterpret_cast<Floats>(
      reinterpret_cast<FloatBits>(a) &
      FloatBits{kNoSign, kNoSign, kNoSign, kNoSign, kNoSign, kNoSign, kNoSign, kNoSign});
}
/// Replaces the last bits, those of `mask`, by those of `number`.
HLC_INLINE Doubles numbered(const Doubles& a, std::uint64_t mask, const Doubles& number) {
  const auto kept = static_cast<long long>(~mask);
  return reinterpret_cast<Doubles>(
      (reinterpret_cast<DoubleBits>(a) & DoubleBits{kept, kept, kept, kept}) |
      reinterpret_cast<DoubleBits>(number));
}
/// One bit per element, the lowest first: a < b?
HLC_INLINE std::uint32_t lanes_less(const Floats& a, const Floats& b) {
  return static_cast<std::uint32_t>(__builtin_ia32_movmskps256(reinterpret_cast<Floats>(a < b)));
}
HLC_INLINE std::uint32_t lanes_less(const Doubles& a, const Doubles& b) {
  return static_cast<std::uint32_t>(__builtin_ia32_movmskpd256(reinterpret_cast<Doubles>(a < b)));
}
/// Of eight floats number 2 kPair four times, then number 2 kPair + 1 four times.
template <int kPair>
HLC_INLINE Floats four_times_two(const Floats& a) {
  constexpr int kFirst = 2 * kPair;
  constexpr int kSecond = kFirst + 1;
  return __builtin_shufflevector(a, a, kFirst, kFirst, kFirst, kFirst, kSecond, kSecond, kSecond,
                                 kSecond);
}
/// Elements 0 and 4, 1 and 5, 2 and 6, 3 and 7.
HLC_INLINE Doubles halves_added(const Floats& a) {
  const auto low = __builtin_shufflevector(a, a, 0, 1, 2, 3);
  const auto high = __builtin_shufflevector(a, a, 4, 5, 6, 7);
  return __builtin_convertvector(low + high, Doubles);
}
#else
/// Two halves: the compiler makes poor code of longer vectors than the processor has.
template <class Half>
struct Pair {
  Half low;
  Half high;

  HLC_INLINE auto operator[](std::size_t i) const {
    constexpr std::size_t kElements = sizeof(Half) / sizeof(low[0]);
    return i < kElements ? low[i] : high[i - kElements];
  }
  HLC_INLINE friend Pair operator+(const Pair& a, const Pair& b) {
    return {a.low + b.low, a.high + b.high};
  }
  HLC_INLINE friend Pair operator-(const Pair& a, const Pair& b) {
    return {a.low - b.low, a.high - b.high};
  }
  HLC_INLINE friend Pair operator*(const Pair& a, const Pair& b) {
    return {a.low * b.low, a.high * b.high};
  }
  HLC_INLINE friend Pair operator/(const Pair& a, const Pair& b) {
    return {a.low / b.low, a.high / b.high};
  }
  HLC_INLINE friend Pair& operator+=(Pair& a, const Pair& b) { return a = a + b; }
};
using HalfDoubles = double __attribute__((vector_size(16)));
using HalfFloats = float __attribute__((vector_size(16)));
using HalfDoubleBits = long long __attribute__((vector_size(16)));
using HalfFloatBits = int __attribute__((vector_size(16)));
using HalfDoublesInMemory = double __attribute__((vector_size(16), aligned(8), may_alias));
using HalfFloatsInMemory = float __attribute__((vector_size(16), aligned(4), may_alias));
using QuarterFloatsInMemory = float __attribute__((vector_size(8), aligned(4), may_alias));
using Doubles = Pair<HalfDoubles>;
using Floats = Pair<HalfFloats>;

HLC_INLINE Doubles load(const double* from) {
  return {*reinterpret_cast<const HalfDoublesInMemory*>(from),
          *reinterpret_cast<const HalfDoublesInMemory*>(from + 2)};
}
HLC_INLINE Floats load(const float* from) {
  return {*reinterpret_cast<const HalfFloatsInMemory*>(from),
          *reinterpret_cast<const HalfFloatsInMemory*>(from + 4)};
}
HLC_INLINE void store(double* to, const Doubles& value) {
  *reinterpret_cast<HalfDoublesInMemory*>(to) = value.low;
  *reinterpret_cast<HalfDoublesInMemory*>(to + 2) = value.high;
}
HLC_INLINE void store(float* to, const Floats& value) {
  *reinterpret_cast<HalfFloatsInMemory*>(to) = value.low;
  *reinterpret_cast<HalfFloatsInMemory*>(to + 4) = value.high;
}
HLC_INLINE void store(float* to, const Doubles& value) {
  using Quarter = float __attribute__((vector_size(8)));
  *reinterpret_cast<QuarterFloatsInMemory*>(to) = __builtin_convertvector(value.low, Quarter);
  *reinterpret_cast<QuarterFloatsInMemory*>(to + 2) = __builtin_convertvector(value.high, Quarter);
}
HLC_INLINE Doubles all(double value) {
  return {HalfDoubles{value, value}, HalfDoubles{value, value}};
}
HLC_INLINE Floats all(float value) {
  return {HalfFloats{value, value, value, value}, HalfFloats{value, value, value, value}};
}
template <class Half>
HLC_INLINE Pair<Half> smaller(const Pair<Half>& a, const Pair<Half>& b) {
  return {a.low < b.low ? a.low : b.low, a.high < b.high ? a.high : b.high};
}
template <class Half>
HLC_INLINE Pair<Half> larger(const Pair<Half>& a, const Pair<Half>& b) {
  return {a.low > b.low ? a.low : b.low, a.high > b.high ? a.high : b.high};
}
template <class Half>
HLC_INLINE Pair<Half> if_less(const Pair<Half>& a, const Pair<Half>& b, const Pair<Half>& then,
                              const Pair<Half>& otherwise) {
  return {a.low < b.low ? then.low : otherwise.low, a.high < b.high ? then.high : otherwise.high};
}
HLC_INLINE HalfDoubles masked(const HalfDoubles& a, std::uint64_t mask) {
  const auto kept = static_cast<long long>(mask);
  return reinterpret_cast<HalfDoubles>(reinterpret_cast<HalfDoubleBits>(a) &
                                       HalfDoubleBits{kept, kept});
}
HLC_INLINE HalfFloats masked(const HalfFloats& a, int kept) {
  return reinterpret_cast<HalfFloats>(reinterpret_cast<HalfFloatBits>(a) &
                                      HalfFloatBits{kept, kept, kept, kept});
}
HLC_INLINE HalfDoubles joined(const HalfDoubles& a, const HalfDoubles& b) {
  return reinterpret_cast<HalfDoubles>(reinterpret_cast<HalfDoubleBits>(a) |
                                       reinterpret_cast<HalfDoubleBits>(b));
}
HLC_INLINE Doubles absolute(const Doubles& a) {
  constexpr std::uint64_t kNoSign = 0x7fff'ffff'ffff'ffff;
  return {masked(a.low, kNoSign), masked(a.high, kNoSign)};
}
HLC_INLINE Floats absolute(const Floats& a) {
  constexpr int kNoSign = 0x7fff'ffff;
  return {masked(a.low, kNoSign), masked(a.high, kNoSign)};
}
HLC_INLINE Doubles numbered(const Doubles& a, std::uint64_t mask, const Doubles& number) {
  return {joined(masked(a.low, ~mask), number.low), joined(masked(a.high, ~mask), number.high)};
}
template <int kPair>
HLC_INLINE Floats four_times_two(const Floats& a) {
  constexpr int kFirst = 2 * kPair % 4;
  constexpr int kSecond = kFirst + 1;
  const HalfFloats& both = kPair < 2 ? a.low : a.high;
  return {__builtin_shufflevector(both, both, kFirst, kFirst, kFirst, kFirst),
          __builtin_shufflevector(both, both, kSecond, kSecond, kSecond, kSecond)};
}
HLC_INLINE Doubles halves_added(const Floats& a) {
  const HalfFloats sum = a.low + a.high;
  return {HalfDoubles{sum[0], sum[1]}, HalfDoubles{sum[2], sum[3]}};
}
HLC_INLINE std::uint32_t signs(const HalfFloats& a) {
#ifdef __SSE2__
  return static_cast<std::uint32_t>(__builtin_ia32_movmskps(a));
#else
  const HalfFloatBits bits = reinterpret_cast<HalfFloatBits>(a);
  return (bits[0] < 0 ? 1U : 0U) | (bits[1] < 0 ? 2U : 0U) | (bits[2] < 0 ? 4U : 0U) |
         (bits[3] < 0 ? 8U : 0U);
#endif
}
HLC_INLINE std::uint32_t signs(const HalfDoubles& a) {
#ifdef __SSE2__
  return static_cast<std::uint32_t>(__builtin_ia32_movmskpd(a));
#else
  const HalfDoubleBits bits = reinterpret_cast<HalfDoubleBits>(a);
  return (bits[0] < 0 ? 1U : 0U) | (bits[1] < 0 ? 2U : 0U);
#endif
}
HLC_INLINE std::uint32_t lanes_less(const Floats& a, const Floats& b) {
  return signs(reinterpret_cast<HalfFloats>(a.low < b.low)) |
         signs(reinterpret_cast<HalfFloats>(a.high < b.high)) << 4U;
}
HLC_INLINE std::uint32_t lanes_less(const Doubles& a, const Doubles& b) {
  return signs(reinterpret_cast<HalfDoubles>(a.low < b.low)) |
         signs(reinterpret_cast<HalfDoubles>(a.high < b.high)) << 2U;
}
#endif

HLC_INLINE double least(const Doubles& a) {
  const double low = a[0] < a[1] ? a[0] : a[1];
  const double high = a[2] < a[3] ? a[2] : a[3];
  return low < high ? low : high;
}
HLC_INLINE double largest(const Doubles& a) {
  const double low = a[0] > a[1] ? a[0] : a[1];
  const double high = a[2] > a[3] ? a[2] : a[3];
  return low > high ? low : high;
}
HLC_INLINE float least(const Floats& a) {
  float value = a[0];
  for (std::size_t i = 1; i < 8; ++i) value = a[i] < value ? a[i] : value;
  return value;
}
HLC_INLINE float largest(const Floats& a) {
  float value = a[0];
  for (std::size_t i = 1; i < 8; ++i) value = a[i] > value ? a[i] : value;
  return value;
}
HLC_INLINE double absolute(double value) { return value < 0.0 ? -value : value; }

}  // namespace
}  // namespace hlc::branch_and_bound
