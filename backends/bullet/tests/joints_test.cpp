// joints_test
