// SPDX-License-Identifier: Apache-2.0
#include "workflows/units.h"

#include <gtest/gtest.h>

#include <numbers>

namespace {

using namespace workflows;

TEST(Units, ValuesInSi) {
  constexpr double pi = std::numbers::pi;
  EXPECT_DOUBLE_EQ(*parse_quantity("12 mm", Dimension::length), 0.012);
  EXPECT_DOUBLE_EQ(*parse_quantity("2 in", Dimension::length), 0.0508);
  EXPECT_DOUBLE_EQ(*parse_quantity("1.5 ms", Dimension::time), 0.0015);
  EXPECT_DOUBLE_EQ(*parse_quantity("3 t", Dimension::mass), 3000);
  EXPECT_DOUBLE_EQ(*parse_quantity("25 rpm", Dimension::angular_velocity), 25 * 2 * pi / 60);
  EXPECT_DOUBLE_EQ(*parse_quantity("-90 deg", Dimension::angle), -pi / 2);
  EXPECT_DOUBLE_EQ(*parse_quantity("2.7 g/cm3", Dimension::density), 2700);
  EXPECT_DOUBLE_EQ(*parse_quantity("70 GPa", Dimension::pressure), 70e9);
  EXPECT_DOUBLE_EQ(*parse_quantity("5 %", Dimension::ratio), 0.05);
  EXPECT_DOUBLE_EQ(*parse_quantity("1 N/mm", Dimension::stiffness_length), 1000);
  EXPECT_DOUBLE_EQ(*parse_quantity("1 N/mm3", Dimension::stiffness_volume), 1e9);
  EXPECT_DOUBLE_EQ(*parse_quantity("9.81 m/s2", Dimension::acceleration), 9.81);
  EXPECT_DOUBLE_EQ(*parse_quantity("50 cm/s", Dimension::speed), 0.5);
}

TEST(Units, AForgottenUnitIsRefused) {
  EXPECT_EQ(parse_quantity("0.25", Dimension::length), std::nullopt);
  EXPECT_EQ(parse_quantity("5 ", Dimension::time), std::nullopt);
  EXPECT_DOUBLE_EQ(*parse_quantity("0", Dimension::length), 0);
  EXPECT_DOUBLE_EQ(*parse_quantity("0.25", Dimension::ratio), 0.25);
}

TEST(Units, SpacesDoNotMatter) {
  EXPECT_DOUBLE_EQ(*parse_quantity("12mm", Dimension::length), 0.012);
  EXPECT_DOUBLE_EQ(*parse_quantity("12   mm  ", Dimension::length), 0.012);
  EXPECT_DOUBLE_EQ(*parse_quantity("1e-3 m", Dimension::length), 1e-3);
}

TEST(Units, OtherTextIsNoQuantity) {
  for (const char* text :
       {"", "mm", "12 kg", "12 MM", "12 mm mm", "12 m m", "nan", "inf m", "1e999 m", "1,5 m", "0x10 m"})
    EXPECT_EQ(parse_quantity(text, Dimension::length), std::nullopt) << text;
  EXPECT_EQ(parse_quantity("12 mm", Dimension::time), std::nullopt);
}

TEST(Units, NamesForMessages) {
  EXPECT_EQ(accepted_units(Dimension::length), "m, cm, mm, um, km, in");
  EXPECT_EQ(accepted_units(Dimension::ratio), "%");
  EXPECT_DOUBLE_EQ(*length_unit("mm"), 1e-3);
  EXPECT_EQ(length_unit("mile"), std::nullopt);
  EXPECT_EQ(length_unit(""), std::nullopt);
}

// Every unit that a message offers is understood.
TEST(Units, EachAcceptedUnitIsParsed) {
  for (const Dimension dimension :
       {Dimension::length, Dimension::time, Dimension::mass, Dimension::speed, Dimension::acceleration,
        Dimension::angle, Dimension::angular_velocity, Dimension::density, Dimension::pressure,
        Dimension::stiffness_volume, Dimension::stiffness_length, Dimension::surface_energy, Dimension::ratio}) {
    std::string list = accepted_units(dimension) + ", ";
    EXPECT_GT(list.size(), 2u);
    for (std::size_t comma; (comma = list.find(", ")) != std::string::npos; list.erase(0, comma + 2))
      EXPECT_TRUE(parse_quantity("1 " + list.substr(0, comma), dimension)) << list;
  }
}

}  // namespace
