#include "hlc_bridge/dds/security.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <random>
#include <stdexcept>

#include "hlc_bridge/dds/participant.hpp"
#include "hlc_bridge/dds/topics.hpp"
#include "hlc_bridge/dds/writer.hpp"
#include "planner/common/text_file.hpp"
#include "tests/hlc_bridge/dds/loopback.hpp"
#include "tests/hlc_bridge/dds/sample_messages.hpp"
#include "tests/support/domain_reservation.hpp"
#include "tests/support/security_folder.hpp"

namespace hlc::dds::security_test {
namespace {

namespace fs = std::filesystem;

fs::path security() {
  static const test::SecurityFolder kFolder("2,3");
  return kFolder.path();
}

fs::path other_authority() {
  static const test::SecurityFolder kFolder("2,3");
  return kFolder.path();
}

std::string refusal(const std::function<void()>& attempt) {
  try {
    attempt();
  } catch (const std::exception& error) {
    return error.what();
  }
  return {};
}

ParticipantOptions secured(const std::string& name, int domain,
                           const fs::path& folder = security()) {
  ParticipantOptions options = on_loopback(name, domain, DomainRole::kController);
  options.security = folder;
  return options;
}

coordination::Prediction some_prediction(std::uint8_t vehicle) {
  std::mt19937_64 random(vehicle);
  auto prediction = sample<coordination::Prediction>(random);
  prediction.vehicle = {vehicle};
  return prediction;
}

TEST(Security, AnIdentityIsTheNameOrTheRoleOfAProcessOfSeveralVehicles) {
  EXPECT_EQ(identity_of("high_level_controller_2"), "high_level_controller_2");
  EXPECT_EQ(identity_of("vehicle_raspberry_1,2,30"), "vehicle_raspberry");
  EXPECT_EQ(identity_of("lab_control"), "lab_control");
}

TEST(Security, NoCertificateCanHaveASubjectThatIsTooLongOrEmpty) {
  EXPECT_TRUE(key_of_identity("middleware_2"));
  EXPECT_NE(key_of_identity("middleware_2"), key_of_identity("middleware_3"));
  EXPECT_FALSE(key_of_identity(std::string(65, 'a')));
  EXPECT_FALSE(key_of_identity(""));
  EXPECT_FALSE(key_of_identity("\xff\xfe"));
}

/// A change of a folder that is then refused.
struct Damage {
  std::string name;
  std::function<void(const fs::path& folder)> change;
  std::string refusal;
};

class DamagedSecurity : public testing::TestWithParam<Damage> {};

TEST_P(DamagedSecurity, IsRefusedWithTheFileAndTheRule) {
  const test::TemporaryFolder folder;
  fs::copy(security(), folder / "copy", fs::copy_options::recursive);
  EXPECT_NO_THROW(static_cast<void>(security_files(folder / "copy", "middleware_2")));
  GetParam().change(folder / "copy");
  const std::string text =
      refusal([&] { static_cast<void>(security_files(folder / "copy", "middleware_2")); });
  EXPECT_THAT(text, testing::StartsWith("--security: " + (folder / "copy").string()));
  EXPECT_THAT(text, testing::HasSubstr(GetParam().refusal));
}

void from_other_authority(const fs::path& folder, const std::string& file) {
  fs::copy_file(other_authority() / file, folder / file, fs::copy_options::overwrite_existing);
}

/// A certificate of the right authority for the same key that is valid no longer.
void let_expire(const fs::path& folder) {
  const std::string command =
      "cd " + folder.string() +
      " && printf '[ca]\\ndefault_ca=a\\n[a]\\ndatabase=index\\nnew_certs_dir=.\\npolicy=p\\n"
      "default_md=sha256\\nrand_serial=yes\\n[p]\\ncommonName=supplied\\n' > ca.cnf && touch index"
      " && openssl req -new -key middleware_2/key.pem -subj /CN=middleware_2 -out request.pem"
      " && openssl ca -batch -config ca.cnf -cert authority.pem -keyfile authority.key"
      " -startdate 20200101000000Z -enddate 20200102000000Z -in request.pem"
      " -out middleware_2/certificate.pem 2> /dev/null";
  if (std::system(command.c_str()) != 0) throw std::runtime_error("failed: " + command);
}

INSTANTIATE_TEST_SUITE_P(
    All, DamagedSecurity,
    testing::Values(
        Damage{"NoIdentity",
               [](const fs::path& folder) { fs::remove_all(folder / "middleware_2"); },
               "middleware_2/certificate.pem: no such file"},
        Damage{"NoGovernance",
               [](const fs::path& folder) { fs::remove(folder / "governance.p7s"); },
               "governance.p7s: no such file"},
        Damage{"NoAuthority", [](const fs::path& folder) { fs::remove(folder / "authority.pem"); },
               "authority.pem: no such file"},
        Damage{"OtherAuthority",
               [](const fs::path& folder) { from_other_authority(folder, "authority.pem"); },
               "must be valid now and signed by the authority.pem"},
        Damage{"Expired", let_expire, "certificate has expired; must be valid now"},
        Damage{"IdentityOfAnotherCar",
               [](const fs::path& folder) {
                 fs::remove_all(folder / "middleware_2");
                 fs::copy(folder / "middleware_3", folder / "middleware_2");
               },
               "the subject must be CN=middleware_2"},
        Damage{"KeyOfAnotherCar",
               [](const fs::path& folder) {
                 fs::copy_file(folder / "middleware_3/key.pem", folder / "middleware_2/key.pem",
                               fs::copy_options::overwrite_existing);
               },
               "must be the key of the certificate.pem"},
        Damage{"KeyThatOthersMayRead",
               [](const fs::path& folder) {
                 fs::permissions(folder / "middleware_2/key.pem", fs::perms::others_read,
                                 fs::perm_options::add);
               },
               "must be of mode 0600"},
        Damage{"NoCertificate",
               [](const fs::path& folder) {
                 write_file(folder / "middleware_2/certificate.pem", "none");
               },
               "must be a certificate (PEM)"},
        Damage{"RightsThatWereChanged",
               [](const fs::path& folder) {
                 const fs::path file = folder / "middleware_2/permissions.p7s";
                 std::string text = read_file(file);
                 text.replace(text.find("DENY"), 4, "ALLOW");
                 write_file(file, text);
               },
               "permissions.p7s: must be signed by the authority.pem of the folder"},
        Damage{"RulesOfAnotherAuthority",
               [](const fs::path& folder) { from_other_authority(folder, "governance.p7s"); },
               "governance.p7s: must be signed by"}),
    [](const auto& one) { return one.param.name; });

TEST(Security, IsRefusedBeforeAParticipantJoinsWithoutIt) {
  const test::DomainReservation reservation(1);
  EXPECT_THAT(refusal([&] { const Participant one(secured("middleware_9", reservation.first())); }),
              testing::HasSubstr("middleware_9/certificate.pem: no such file"));
  EXPECT_THAT(refusal([&] {
                const Participant one(secured("middleware_2", reservation.first(), "nowhere"));
              }),
              testing::HasSubstr("nowhere/authority.pem: no such file"));
}

TEST(Security, ExcludesADiscoveryServer) {
  ParticipantOptions options = secured("middleware_2", 1);
  options.discovery_server = {
      .guid_prefix = "44.53.00.5f.45.50.52.4f.53.49.4d.41", .ip = "127.0.0.1", .port = 11811};
  EXPECT_THAT(refusal([&] { const Participant one(options); }),
              testing::HasSubstr("--discovery_mode"));
}

class SecurityOnADomain : public testing::Test {
 protected:
  [[nodiscard]] int domain() const { return reservation_.first(); }
  /// The same options with their log lines counted.
  [[nodiscard]] ParticipantOptions logging(ParticipantOptions options) {
    options.on_loss = [this](const std::string& line) {
      log_.post([&] { lines_.push_back(line); });
    };
    return options;
  }
  /// As soon as there are `count`.
  [[nodiscard]] std::vector<std::string> log_lines(std::size_t count) const {
    static_cast<void>(log_.wait_until(soon(), [&] { return lines_.size() >= count; }));
    return log_.locked([&] { return lines_; });
  }

  test::DomainReservation reservation_{1};
  time::Signal log_;
  std::vector<std::string> lines_;
};

// A stranger without an identity and one of another authority publish in a car's name and read.
TEST_F(SecurityOnADomain, ConnectsItsOwnParticipantsAndNoOther) {
  Participant stranger(on_loopback("stranger", domain(), DomainRole::kController));
  Participant foreigner(secured("high_level_controller_2", domain(), other_authority()));
  const Mailbox<coordination::Prediction> read_by_stranger(stranger, topics::prediction());
  const Mailbox<coordination::Prediction> read_by_foreigner(foreigner, topics::prediction());
  Writer<coordination::Prediction> forged(stranger, topics::prediction());
  Writer<coordination::Prediction> forged_too(foreigner, topics::prediction());

  Participant second(secured("high_level_controller_2", domain()));
  Participant third(logging(secured("high_level_controller_3", domain())));
  Writer<coordination::Prediction> writer(second, topics::prediction());
  const Mailbox<coordination::Prediction> mailbox(third, topics::prediction());
  ASSERT_TRUE(writer.wait_for_matched(1, soon()));
  ASSERT_TRUE(third.wait_for({"high_level_controller_2"}, soon()));
  for (int i = 0; i < 20; ++i) {
    static_cast<void>(forged.write(some_prediction(7)));
    static_cast<void>(forged_too.write(some_prediction(8)));
    ASSERT_TRUE(writer.write(some_prediction(2)));
  }
  EXPECT_THAT(mailbox.wait_for(20), testing::Each(some_prediction(2)));
  EXPECT_THAT(read_by_stranger.now(), testing::IsEmpty());
  EXPECT_THAT(read_by_foreigner.now(), testing::IsEmpty());
  EXPECT_EQ(second.alive(), std::set<std::string>{"high_level_controller_3"});
  EXPECT_EQ(third.alive(), std::set<std::string>{"high_level_controller_2"});
  EXPECT_THAT(log_lines(1), testing::Contains(testing::ContainsRegex("\"stranger\" .* refused")));
}

TEST_F(SecurityOnADomain, LetsAParticipantPublishAndReadItsOwnTopicsOnly) {
  ParticipantOptions options = secured("middleware_2", domain());
  options.role = DomainRole::kLab;
  Participant second(options);
  const auto write_to = [&](std::uint8_t vehicle) {
    return refusal(
        [&] { const Writer<TrajectoryCommand> writer(second, topics::vehicle_command(vehicle)); });
  };
  EXPECT_EQ(write_to(2), "");
  EXPECT_THAT(write_to(3), testing::HasSubstr("vehicle/3/vehicleCommandTrajectory"));
  EXPECT_THAT(refusal([&] { const Mailbox<Log> log(second, topics::log()); }),
              testing::HasSubstr("topic log"));
}

TEST_F(SecurityOnADomain, NoticesWhoLeavesAndWhoReturns) {
  Participant second(secured("high_level_controller_2", domain()));
  {
    const Participant third(secured("high_level_controller_3", domain()));
    ASSERT_TRUE(second.wait_for({"high_level_controller_3"}, soon()));
  }
  const auto deadline = soon();
  while (!second.is_lost("high_level_controller_3")) {
    ASSERT_LT(std::chrono::steady_clock::now(), deadline);
  }
  const Participant again(secured("high_level_controller_3", domain()));
  EXPECT_TRUE(second.wait_for({"high_level_controller_3"}, soon()));
}

}  // namespace
}  // namespace hlc::dds::security_test
