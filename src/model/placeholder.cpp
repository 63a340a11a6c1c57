namespace rholm {}
