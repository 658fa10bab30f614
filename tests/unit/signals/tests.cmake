pliant_test(signals_test
  SOURCES ${CMAKE_CURRENT_LIST_DIR}/pchip_test.cpp ${CMAKE_CURRENT_LIST_DIR}/make_signal_test.cpp
    ${CMAKE_CURRENT_LIST_DIR}/balance_test.cpp
  LIBS pliant_signals GTest::gmock)
