#pragma once

#if defined(HALFSPACE_REF_GMP)
#include <boost/multiprecision/gmp.hpp>
#else
#include <boost/multiprecision/cpp_int.hpp>
#endif

namespace halfspace::ref {

/// The rationals of Boost.Multiprecision: over GMP where it is installed (four
/// times faster), else all Boost's own.
#if defined(HALFSPACE_REF_GMP)
using BigRational =
    boost::multiprecision::number<boost::multiprecision::gmp_rational,
                                  boost::multiprecision::et_off>;
#else
using BigRational = boost::multiprecision::number<
    boost::multiprecision::rational_adaptor<
        boost::multiprecision::cpp_int_backend<> >,
    boost::multiprecision::et_off>;
#endif
using BigInteger = boost::multiprecision::component_type<BigRational>::type;

/// The greatest integer not above the value.
BigInteger floor_of(const BigRational& value);

/// The double nearest to the value, ties to even; infinite beyond doubles.
double nearest_double(const BigRational& value);

}  // namespace halfspace::ref
