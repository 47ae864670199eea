#include "ui/desktop_portal.h"

#include <gtest/gtest.h>

#include "private_bus.h"
#include "ui/desktop_chooser.h"

namespace osteon {
namespace {

TEST(PathOfUri, OnlyFilesOfThisComputerAreTakenAndTheirBytesAreDecoded) {
  EXPECT_EQ(path_of_uri(""), std::nullopt);
  EXPECT_EQ(path_of_uri("file://"), std::nullopt);
  EXPECT_EQ(path_of_uri("https://example.org/a.stl"), std::nullopt);
  EXPECT_EQ(path_of_uri("file://elsewhere/a.stl"), std::nullopt);
  EXPECT_EQ(path_of_uri("file:///a.stl"), "/a.stl");
  EXPECT_EQ(path_of_uri("file://localhost/a.stl"), "/a.stl");
  EXPECT_EQ(path_of_uri("file:///my%20knee/Kn%C3%B6chel%2f1.stl"),
            "/my knee/Kn\xC3\xB6"
            "chel/1.stl");
  EXPECT_EQ(path_of_uri("file:///50%/a%2"), "/50%/a%2") << "no escapes";
}

class DesktopPortal : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!load_libsdbus(libsdbus_file())) GTEST_SKIP() << "systemd's library is not installed";
    if (!bus_.works()) GTEST_SKIP() << "dbus-daemon is not installed";
  }
  PrivateBus bus_;
};

TEST_F(DesktopPortal, WithoutABusOrAPortalThereIsNone) {
  EXPECT_EQ(desktop_chooser_version(), 0u);
  EXPECT_FALSE(choose_on_desktop({"Open"}, {})) << "it does not wait for what is not there";
  ::setenv("DBUS_SESSION_BUS_ADDRESS", "unix:path=/not/there", 1);
  EXPECT_EQ(desktop_chooser_version(), 0u);
  EXPECT_FALSE(choose_on_desktop({"Open"}, {}));
}

TEST_F(DesktopPortal, WhatTheUserChoosesIsReturnedAndTheQuestionIsAsAsked) {
  const FakePortal portal({});
  EXPECT_EQ(desktop_chooser_version(), 4u);
  auto chosen = choose_on_desktop({"Open", false, "x11:1a"}, {});
  ASSERT_TRUE(chosen) << chosen.error().message();
  EXPECT_EQ(*chosen, std::vector<std::string>{"/tmp/a case"});
  EXPECT_EQ(portal.parent(), "x11:1a");
  EXPECT_TRUE(portal.for_several());
  EXPECT_FALSE(portal.for_folder());
  chosen = choose_on_desktop({"Open", true}, {});
  ASSERT_TRUE(chosen) << chosen.error().message();
  EXPECT_FALSE(portal.for_several());
  EXPECT_TRUE(portal.for_folder());
}

TEST_F(DesktopPortal, AnOldPortalThatNamesItsOwnObjectIsHeard) {
  // Its answer may come before the second question to the bus; the user never is that quick.
  FakePortal::Manners manners;
  manners.own_handle = true;
  manners.answers = false;
  const FakePortal portal(manners);
  int looks = 0;
  const auto chosen = choose_on_desktop({"Open"}, [&](const char*, double) { return ++looks < 3; });
  ASSERT_TRUE(chosen);
  EXPECT_TRUE(chosen->empty());
  EXPECT_TRUE(portal.closed()) << "on the object that the portal named";
}

TEST_F(DesktopPortal, CancelledIsNothingAndWhatIsNoFileIsAnError) {
  FakePortal::Manners manners;
  manners.response = 1;
  {
    const FakePortal portal(manners);
    const auto chosen = choose_on_desktop({"Open"}, {});
    ASSERT_TRUE(chosen);
    EXPECT_TRUE(chosen->empty());
  }
  manners.response = 2;
  {
    const FakePortal portal(manners);
    EXPECT_FALSE(choose_on_desktop({"Open"}, {}));
  }
  manners.response = 0;
  manners.uri = "https://example.org/a.stl";
  const FakePortal portal(manners);
  EXPECT_FALSE(choose_on_desktop({"Open"}, {}));
}

TEST_F(DesktopPortal, TheWindowOffersWhatThePortalCanAndClosesItsChooserAtTheEnd) {
  FakePortal::Manners manners;
  manners.version = 2;
  manners.answers = false;
  const FakePortal portal(manners);
  {
    DesktopChooser chooser;
    EXPECT_FALSE(chooser.offers_files()) << "not looked for yet";
    chooser.look_for();
    while (!chooser.offers_files()) std::this_thread::yield();
    EXPECT_FALSE(chooser.offers_folders()) << "from version 3";
    chooser.ask({"Open"});
    EXPECT_TRUE(chooser.asks());
    while (!portal.asked()) std::this_thread::yield();
    const auto nothing = chooser.take();
    ASSERT_TRUE(nothing);
    EXPECT_TRUE(nothing->empty());
    EXPECT_TRUE(chooser.asks());
  }
  EXPECT_TRUE(portal.closed());
}

TEST_F(DesktopPortal, TheWindowTakesTheChoiceOnceAndMayAskAgain) {
  const FakePortal portal({});
  DesktopChooser chooser;
  for (int times = 0; times < 2; ++times) {
    chooser.ask({"Open"});
    Result<std::vector<std::string>> chosen;
    while (chooser.asks()) chosen = chooser.take();
    ASSERT_TRUE(chosen);
    EXPECT_EQ(*chosen, std::vector<std::string>{"/tmp/a case"});
    EXPECT_TRUE(chooser.take()->empty());
  }
}

}  // namespace
}  // namespace osteon
