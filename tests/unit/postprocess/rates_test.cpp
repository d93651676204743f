// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "postprocess/discharge.h"
#include "postprocess/mill_power.h"

namespace postprocess {
namespace {

std::vector<double> times_to(double end, int rows) {
  std::vector<double> times;
  for (int i = 0; i <= rows; ++i) times.push_back(end * i / rows);
  return times;
}

TEST(IntervalMean, OfASteadyRateIsTheRateWithoutDoubt) {
  const std::vector<double> times = times_to(10, 97);
  std::vector<double> amount;
  for (const double t : times) amount.push_back(3 * t + 1);
  const IntervalMean mean = mean_rate(times, amount, 2.05, 9.3, 6);
  EXPECT_NEAR(mean.mean, 3, 1e-12);
  EXPECT_NEAR(mean.half_width, 0, 1e-12);
}

TEST(IntervalMean, HalfWidthIsStudentsForTheBatches) {
  // Two batches of rates 1 and 3: mean 2, standard error 1, one degree of freedom.
  const IntervalMean mean = mean_rate({0, 1, 2}, {0, 1, 4}, 0, 2, 2);
  EXPECT_DOUBLE_EQ(mean.mean, 2);
  EXPECT_NEAR(mean.half_width, 12.706, 1e-9);
}

TEST(IntervalMean, HoldsTheTrueMeanNineteenTimesInTwenty) {
  std::mt19937 random(11);
  std::normal_distribution<double> normal(5, 2);
  int held = 0;
  const std::vector<double> times = times_to(1, 60);
  for (int trial = 0; trial < 2000; ++trial) {
    std::vector<double> rate;
    for (std::size_t i = 0; i < times.size(); ++i) rate.push_back(normal(random));
    const IntervalMean mean = mean_rate(times, integral_of_averages(times, rate), 0, 1, 6);
    held += std::abs(mean.mean - 5) <= mean.half_width ? 1 : 0;
  }
  EXPECT_NEAR(held / 2000.0, 0.95, 0.02);  // four standard errors of a share of 0.95
}

TEST(StudentT, TableAndExpansionMeet) {
  EXPECT_GT(student_t_95(30), student_t_95(31));
  EXPECT_NEAR(student_t_95(40), 2.021, 1e-3);  // Abramowitz & Stegun, table 26.10
  EXPECT_NEAR(student_t_95(120), 1.980, 1e-3);
}

TEST(MillPower, ComesExactlyFromAConstantTorque) {
  const double speed = 2.5, torque = -40;
  const std::vector<double> times = times_to(7.3, 351);
  const MillLoads loads{times, std::vector<double>(times.size(), torque), speed};
  const RevolutionWindow window = whole_revolutions(times, speed);
  const IntervalMean power = power_from_torque(loads, window);
  EXPECT_NEAR(power.mean, 100, 1e-9);
  EXPECT_NEAR(power.half_width, 0, 1e-9);
}

TEST(MillPower, ARippleAveragesOutOverWholeRevolutions) {
  const double speed = -1.3, period = 2 * std::numbers::pi / 1.3;
  const std::vector<double> times = times_to(3.4 * period, 4000);
  MillLoads loads{times, {0}, speed};
  // Averages of 50 + 20 sin(8 speed t) over each row's interval, integrated by hand.
  const auto integral = [&](double t) { return 50 * t - 20 * std::cos(8 * speed * t) / (8 * speed); };
  for (std::size_t i = 1; i < times.size(); ++i)
    loads.torque.push_back((integral(times[i]) - integral(times[i - 1])) / (times[i] - times[i - 1]));
  const RevolutionWindow window = whole_revolutions(times, speed);
  EXPECT_EQ(window.revolutions, 2);  // three fit, the first is start-up
  EXPECT_NEAR(window.to_time - window.from_time, 2 * period, 1e-12);
  EXPECT_NEAR(power_from_torque(loads, window).mean, 1.3 * 50, 1e-4);
  EXPECT_EQ(whole_revolutions(times, speed, 1).revolutions, 1);
}

TEST(MillPower, LedgerCountsWhatIsStoredAndWhatIsLost) {
  const std::vector<double> times = times_to(10, 200);
  EnergyAccounts accounts{times, {}, {}};
  for (const double t : times) {
    accounts.stored.push_back(3 + 0.5 * t);
    accounts.dissipated.push_back(7 * t);
  }
  EXPECT_NEAR(power_from_ledger(accounts, whole_revolutions(times, 2.0)).mean, 7.5, 1e-12);
}

TEST(MillPower, SpeedIsFoundFromTorqueAndPower) {
  EXPECT_NEAR(angular_speed_from({1, -2, 4}, {-2.5, 5, -10}), 2.5, 1e-12);
  EXPECT_EQ(angular_speed_from({0, 0}, {0, 0}), 0);
}

TEST(MillPower, LessThanARevolutionFallsBackOnTheSecondHalf) {
  const RevolutionWindow window = whole_revolutions({0, 1, 2}, 0.1);
  EXPECT_EQ(window.revolutions, 0);
  EXPECT_EQ(window.from_time, 1);
  EXPECT_EQ(window.to_time, 2);
}

TEST(Discharge, SteadyRateAndFirstBody) {
  std::vector<double> times = times_to(10, 400), mass, count;
  for (const double t : times) {
    count.push_back(std::floor(std::min(300.0, std::max(0.0, 50 * (t - 2)))));
    mass.push_back(0.1 * count.back());
  }
  const Discharge out = discharge(times, mass, count);
  EXPECT_NEAR(out.mass, 30, 1e-12);
  EXPECT_EQ(out.count, 300);
  EXPECT_NEAR(out.first_time, 2.025, 0.026);
  EXPECT_NEAR(out.rate.mean, 5, 0.05);
  EXPECT_NEAR(out.rate.from_time, 2 + 0.1 * 6, 0.05);
  EXPECT_NEAR(out.rate.to_time, 2 + 0.8 * 6, 0.05);
  EXPECT_EQ(discharge(times, std::vector<double>(401, 0.0), std::vector<double>(401, 0.0)).count, 0);
}

TEST(RateCurve, GivesBackTheWholeAmount) {
  const std::vector<double> times = times_to(4, 77);
  std::vector<double> amount;
  for (const double t : times) amount.push_back(t * t * t);
  const RateCurve curve = rate_curve(times, amount, 9);
  double sum = 0;
  for (const double rate : curve.rates) sum += rate * 4 / 9;
  EXPECT_NEAR(sum, 64, 1e-9);
}

}  // namespace
}  // namespace postprocess
