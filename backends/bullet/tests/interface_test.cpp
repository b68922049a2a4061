// interface_test
