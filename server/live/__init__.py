"""What is going on, as everyone may see it, pushed to everyone who watches."""
