"""When the running job reaches what people wait for, as far as that can be told."""
