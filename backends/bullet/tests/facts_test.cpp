// facts_test
