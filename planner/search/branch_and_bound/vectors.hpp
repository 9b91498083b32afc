#pragma once

#include <cstddef>
#include <cstdint>

/// Four doubles, eight floats or sixteen 16-bit integers at a time, for the kernel of
/// BranchAndBound alone: with AVX2 one register, otherwise halves of the 16 bytes that every x86-64
/// processor has (and, written with the compiler's vectors, others too). The same operations give
/// the same bits both ways.
///
/// Everything is inlined and in an unnamed namespace: the translation units that include this must
/// not share a function.
namespace hlc::search::branch_and_bound {
namespace {

#define HLC_INLINE [[gnu::always_inline]] inline

using HalfDoubles = double __attribute__((vector_size(16)));

#ifdef __AVX2__
using Doubles = double __attribute__((vector_size(32)));
using Floats = float __attribute__((vector_size(32)));
using DoubleBits = long long __attribute__((vector_size(32)));
using FloatBits = int __attribute__((vector_size(32)));
using Shorts = short __attribute__((vector_size(32)));
/// The same in memory, at any address of an element.
using DoublesInMemory = double __attribute__((vector_size(32), aligned(8), may_alias));
using FloatsInMemory = float __attribute__((vector_size(32), aligned(4), may_alias));
using HalfFloatsInMemory = float __attribute__((vector_size(16), aligned(4), may_alias));
using ShortsInMemory = short __attribute__((vector_size(32), aligned(2), may_alias));

HLC_INLINE Doubles load(const double* from) {
  return *reinterpret_cast<const DoublesInMemory*>(from);
}
HLC_INLINE Floats load(const float* from) { return *reinterpret_cast<const FloatsInMemory*>(from); }
HLC_INLINE Shorts load(const std::int16_t* from) {
  return *reinterpret_cast<const ShortsInMemory*>(from);
}
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
HLC_INLINE Shorts all_shorts(std::int16_t value) {
  return Shorts{value, value, value, value, value, value, value, value,
                value, value, value, value, value, value, value, value};
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
/// Per element: a == b ? then : otherwise.
HLC_INLINE Doubles if_equal(const Doubles& a, const Doubles& b, const Doubles& then,
                            const Doubles& otherwise) {
  return a == b ? then : otherwise;
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
/// Per element: is its bit of the last four set? then : otherwise.
HLC_INLINE Doubles where_set(std::uint32_t four, const Doubles& then, const Doubles& otherwise) {
  const auto bits = static_cast<long long>(four);
  const DoubleBits places{1, 2, 4, 8};
  return (DoubleBits{bits, bits, bits, bits} & places) == places ? then : otherwise;
}
/// Replaces the last bits, those of `mask`, by those of `number`.
HLC_INLINE Doubles numbered(const Doubles& a, std::uint64_t mask, const Doubles& number) {
  const auto kept = static_cast<long long>(~mask);
  return reinterpret_cast<Doubles>(
      (reinterpret_cast<DoubleBits>(a) & DoubleBits{kept, kept, kept, kept}) |
      reinterpret_cast<DoubleBits>(number));
}
/// One bit per element, the lowest first: a < b?
#ifdef __AVX512VL__
constexpr int kLess = 0x11;  // not if one is no number
HLC_INLINE std::uint32_t lanes_less(const Floats& a, const Floats& b) {
  return static_cast<std::uint8_t>(__builtin_ia32_cmpps256_mask(a, b, kLess, 0xff));
}
HLC_INLINE std::uint32_t lanes_less(const Doubles& a, const Doubles& b) {
  return static_cast<std::uint8_t>(__builtin_ia32_cmppd256_mask(a, b, kLess, 0x0f));
}
#else
HLC_INLINE std::uint32_t lanes_less(const Floats& a, const Floats& b) {
  return static_cast<std::uint32_t>(__builtin_ia32_movmskps256(reinterpret_cast<Floats>(a < b)));
}
HLC_INLINE std::uint32_t lanes_less(const Doubles& a, const Doubles& b) {
  return static_cast<std::uint32_t>(__builtin_ia32_movmskpd256(reinterpret_cast<Doubles>(a < b)));
}
#endif
/// Limited to 16 bits.
HLC_INLINE Shorts difference(const Shorts& a, const Shorts& b) {
  return __builtin_ia32_psubsw256(a, b);
}
/// Rounded to whole numbers, halves to even ones, limited to 16 bits: a[0] ... a[3], b[0] ... b[3],
/// a[4] ... a[7], b[4] ... b[7]. @pre they fit into 32 bits
HLC_INLINE Shorts rounded(const Floats& a, const Floats& b) {
  return __builtin_ia32_packssdw256(__builtin_ia32_cvtps2dq256(a), __builtin_ia32_cvtps2dq256(b));
}
/// Of each half the two from number 2 kTwo on, four times.
template <int kTwo>
HLC_INLINE Shorts four_times_two(const Shorts& a) {
  const auto twos = reinterpret_cast<FloatBits>(a);
  return reinterpret_cast<Shorts>(__builtin_shufflevector(twos, twos, kTwo, kTwo, kTwo, kTwo,
                                                          kTwo + 4, kTwo + 4, kTwo + 4, kTwo + 4));
}
/// Elements 2 and 3 swapped with 4 and 5.
HLC_INLINE Floats middle_swapped(const Floats& a) {
  return __builtin_shufflevector(a, a, 0, 1, 4, 5, 2, 3, 6, 7);
}
/// Squares of consecutive pairs, added.
HLC_INLINE Floats squares_of_two_added(const Shorts& a) {
  return __builtin_convertvector(__builtin_ia32_pmaddwd256(a, a), Floats);
}
/// Keeps the computation of dependent values inside a loop: sixteen registers are not enough to
/// keep them all, and memory is slower (with more registers it makes no difference).
HLC_INLINE void stay_in_loop(Shorts& a) { asm("" : "+x"(a)); }
HLC_INLINE Doubles halves_swapped(const Doubles& a) {
  return __builtin_shufflevector(a, a, 2, 3, 0, 1);
}
HLC_INLINE bool are_equal(const Doubles& a, const Doubles& b) {
  return __builtin_ia32_movmskpd256(reinterpret_cast<Doubles>(a == b)) == 0xf;
}
/// The smaller of elements 0 and 2 and of 1 and 3.
HLC_INLINE HalfDoubles smaller_half(const Doubles& a) {
  const HalfDoubles low = __builtin_shufflevector(a, a, 0, 1);
  const HalfDoubles high = __builtin_shufflevector(a, a, 2, 3);
  return low < high ? low : high;
}
/// Elements 0 and 4, 1 and 5, 2 and 6, 3 and 7.
HLC_INLINE Doubles halves_added(const Floats& a) {
  const auto low = __builtin_shufflevector(a, a, 0, 1, 2, 3);
  const auto high = __builtin_shufflevector(a, a, 4, 5, 6, 7);
  return __builtin_ia32_cvtps2pd256(low + high);
}
#else
/// Two halves: the compiler generates poor code for vectors longer than the processor's.
using HalfShorts = short __attribute__((vector_size(16)));

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
using HalfFloats = float __attribute__((vector_size(16)));
using HalfDoubleBits = long long __attribute__((vector_size(16)));
using HalfFloatBits = int __attribute__((vector_size(16)));
using HalfDoublesInMemory = double __attribute__((vector_size(16), aligned(8), may_alias));
using HalfFloatsInMemory = float __attribute__((vector_size(16), aligned(4), may_alias));
using QuarterFloatsInMemory = float __attribute__((vector_size(8), aligned(4), may_alias));
using HalfShortsInMemory = short __attribute__((vector_size(16), aligned(2), may_alias));
using Doubles = Pair<HalfDoubles>;
using Floats = Pair<HalfFloats>;
using Shorts = Pair<HalfShorts>;

HLC_INLINE Doubles load(const double* from) {
  return {*reinterpret_cast<const HalfDoublesInMemory*>(from),
          *reinterpret_cast<const HalfDoublesInMemory*>(from + 2)};
}
HLC_INLINE Floats load(const float* from) {
  return {*reinterpret_cast<const HalfFloatsInMemory*>(from),
          *reinterpret_cast<const HalfFloatsInMemory*>(from + 4)};
}
HLC_INLINE Shorts load(const std::int16_t* from) {
  return {*reinterpret_cast<const HalfShortsInMemory*>(from),
          *reinterpret_cast<const HalfShortsInMemory*>(from + 8)};
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
HLC_INLINE Shorts all_shorts(std::int16_t value) {
  const HalfShorts half{value, value, value, value, value, value, value, value};
  return {half, half};
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
HLC_INLINE Doubles if_equal(const Doubles& a, const Doubles& b, const Doubles& then,
                            const Doubles& otherwise) {
  return {a.low == b.low ? then.low : otherwise.low, a.high == b.high ? then.high : otherwise.high};
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
HLC_INLINE HalfDoubles where_two_set(std::uint32_t two, const HalfDoubles& then,
                                     const HalfDoubles& otherwise) {
  const HalfDoubleBits set{-static_cast<long long>(two & 1U),
                           -static_cast<long long>(two >> 1U & 1U)};
  return set != 0 ? then : otherwise;
}
HLC_INLINE Doubles where_set(std::uint32_t four, const Doubles& then, const Doubles& otherwise) {
  return {where_two_set(four, then.low, otherwise.low),
          where_two_set(four >> 2U, then.high, otherwise.high)};
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
#ifdef __SSE2__
HLC_INLINE HalfShorts difference(const HalfShorts& a, const HalfShorts& b) {
  return __builtin_ia32_psubsw128(a, b);
}
HLC_INLINE HalfShorts rounded(const HalfFloats& a, const HalfFloats& b) {
  return __builtin_ia32_packssdw128(__builtin_ia32_cvtps2dq(a), __builtin_ia32_cvtps2dq(b));
}
HLC_INLINE HalfFloatBits squares_of_two_added(const HalfShorts& a) {
  return __builtin_ia32_pmaddwd128(a, a);
}
#else
HLC_INLINE short limited(int value) {
  return static_cast<short>(value < -32768 ? -32768 : value > 32767 ? 32767 : value);
}
HLC_INLINE HalfShorts difference(const HalfShorts& a, const HalfShorts& b) {
  HalfShorts result{};
  for (std::size_t i = 0; i < 8; ++i) result[i] = limited(a[i] - b[i]);
  return result;
}
HLC_INLINE short rounded(float value) {
  if (!(value > -32768.0F)) return -32768;
  return value < 32767.0F ? static_cast<short>(__builtin_rintf(value)) : 32767;
}
HLC_INLINE HalfShorts rounded(const HalfFloats& a, const HalfFloats& b) {
  HalfShorts result{};
  for (std::size_t i = 0; i < 4; ++i) {
    result[i] = rounded(a[i]);
    result[i + 4] = rounded(b[i]);
  }
  return result;
}
HLC_INLINE HalfFloatBits squares_of_two_added(const HalfShorts& a) {
  HalfFloatBits result{};
  for (std::size_t i = 0; i < 4; ++i) result[i] = a[2 * i] * a[2 * i] + a[2 * i + 1] * a[2 * i + 1];
  return result;
}
#endif
HLC_INLINE Shorts difference(const Shorts& a, const Shorts& b) {
  return {difference(a.low, b.low), difference(a.high, b.high)};
}
HLC_INLINE Shorts rounded(const Floats& a, const Floats& b) {
  return {rounded(a.low, b.low), rounded(a.high, b.high)};
}
template <int kTwo>
HLC_INLINE Shorts four_times_two(const Shorts& a) {
  const auto low = reinterpret_cast<HalfFloatBits>(a.low);
  const auto high = reinterpret_cast<HalfFloatBits>(a.high);
  return {
      reinterpret_cast<HalfShorts>(__builtin_shufflevector(low, low, kTwo, kTwo, kTwo, kTwo)),
      reinterpret_cast<HalfShorts>(__builtin_shufflevector(high, high, kTwo, kTwo, kTwo, kTwo))};
}
HLC_INLINE Floats middle_swapped(const Floats& a) {
  return {__builtin_shufflevector(a.low, a.high, 0, 1, 4, 5),
          __builtin_shufflevector(a.low, a.high, 2, 3, 6, 7)};
}
HLC_INLINE void stay_in_loop(Shorts&) {}
HLC_INLINE Floats squares_of_two_added(const Shorts& a) {
  return {__builtin_convertvector(squares_of_two_added(a.low), HalfFloats),
          __builtin_convertvector(squares_of_two_added(a.high), HalfFloats)};
}
HLC_INLINE Doubles halves_added(const Floats& a) {
  const HalfFloats sum = a.low + a.high;
  return {HalfDoubles{sum[0], sum[1]}, HalfDoubles{sum[2], sum[3]}};
}
HLC_INLINE HalfDoubles smaller_half(const Doubles& a) { return a.low < a.high ? a.low : a.high; }
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
HLC_INLINE Doubles halves_swapped(const Doubles& a) { return {a.high, a.low}; }
HLC_INLINE bool are_equal(const Doubles& a, const Doubles& b) {
  return (signs(reinterpret_cast<HalfDoubles>(a.low == b.low)) &
          signs(reinterpret_cast<HalfDoubles>(a.high == b.high))) == 3;
}
#endif

HLC_INLINE double least(const Doubles& a) {
  const HalfDoubles half = smaller_half(a);
  return half[0] < half[1] ? half[0] : half[1];
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
}  // namespace hlc::search::branch_and_bound
