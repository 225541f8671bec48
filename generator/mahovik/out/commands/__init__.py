"""The commands: one module each, with one public function of the same name, which Python users call as well."""
