"""Where the own authority lives, below the data folder."""

FOLDER = "tls"
ROOT_FILE = "root.crt"
